// raytrace-convert FILE BYTES: writes a model of any format that Assimp reads on standard output, as a GLB file
// (glTF 2.0). Takes at most so many bytes of memory. What is wrong is a line on standard error, and the exit code 1.
// raytrace starts it (lib/raytrace/import/converted_model.h).
#include <assimp/config.h>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <assimp/Exporter.hpp>
#include <assimp/Importer.hpp>
#include <cctype>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace {

namespace fs = std::filesystem;

void limit(int resource, rlim_t most) {
  rlimit limits{};
  if (getrlimit(static_cast<__rlimit_resource>(resource), &limits) != 0) return;
  limits.rlim_cur = std::min(limits.rlim_cur, most);
  setrlimit(static_cast<__rlimit_resource>(resource), &limits);
}

/// A damaged file may ask for endless time or memory.
void set_limits(rlim_t memory) {
  constexpr rlim_t seconds = 600;
  limit(RLIMIT_CPU, seconds);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_FSIZE, memory);
#if !defined(RAYTRACE_SANITIZED)  // sanitizers reserve far more than they use
  limit(RLIMIT_AS, memory);
#endif
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // nobody waits for it then
}

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// The file of that name in the folder, or one whose name differs in the case of its letters.
std::optional<fs::path> file_in(const fs::path& folder, const fs::path& name) {
  std::error_code error;
  if (fs::is_regular_file(folder / name, error)) return name;
  const fs::path parent = name.parent_path();
  for (const fs::directory_entry& entry : fs::directory_iterator(folder.empty() ? "." : folder / parent, error))
    if (lower(entry.path().filename()) == lower(name.filename())) return parent / entry.path().filename();
  return std::nullopt;
}

/// The texture's file, relative to the model's folder, if there is one: many models have names of files on the machine
/// that they were made on.
std::optional<fs::path> find_texture(std::string name, const fs::path& model) {
  std::replace(name.begin(), name.end(), '\\', '/');
  const fs::path path(name), file = path.filename(), beside = model.stem().string() + ".fbm";
  if (file.empty()) return std::nullopt;
  for (const fs::path& candidate : {path, file, "textures" / file, "Textures" / file, "tex" / file, beside / file})
    if (const auto found = file_in(model.parent_path(), candidate)) return found;
  return std::nullopt;
}

void find_textures(const aiScene& scene, const fs::path& model) {
  for (unsigned i = 0; i < scene.mNumMaterials; ++i) {
    aiMaterial& material = *scene.mMaterials[i];
    for (int type = aiTextureType_DIFFUSE; type <= AI_TEXTURE_TYPE_MAX; ++type) {
      const auto texture_type = static_cast<aiTextureType>(type);
      for (unsigned index = 0; index < material.GetTextureCount(texture_type); ++index) {
        aiString name;
        if (material.GetTexture(texture_type, index, &name) != AI_SUCCESS || name.length == 0) continue;
        if (scene.GetEmbeddedTexture(name.C_Str()) != nullptr) continue;
        if (const auto found = find_texture(name.C_Str(), model)) {
          const aiString better(found->string());
          material.AddProperty(&better, AI_MATKEY_TEXTURE(texture_type, index));
        }
      }
    }
  }
}

/// glTF has two texture coordinates, where other formats may have three.
void drop_third_coordinates(const aiScene& scene) {
  for (unsigned i = 0; i < scene.mNumMeshes; ++i)
    for (unsigned& components : scene.mMeshes[i]->mNumUVComponents) components = std::min(components, 2U);
}

/// Whether z is up in all files of a format whose importer leaves it so, as those of 3ds and ASE do not. Where files
/// say it, importers follow them. AMF has no such rule, as STL has none.
bool has_z_up(const fs::path& model) {
  const std::string type = lower(model.extension());
  return type == ".blend" || type == ".3mf";
}

/// To glTF's axes.
void turn_y_up(const aiScene& scene) {
  aiMatrix4x4 turn;
  aiMatrix4x4::RotationX(static_cast<ai_real>(-AI_MATH_HALF_PI), turn);
  scene.mRootNode->mTransformation = turn * scene.mRootNode->mTransformation;
}

/// Of a mesh without normals that does not move. Where faces share vertices, Assimp's smooth normals would be those of
/// the last face of each: they need vertices of its own for each face, and find those of one position themselves.
void split_faces(aiMesh& mesh) {
  if (mesh.HasNormals() || mesh.HasBones() || mesh.mNumAnimMeshes > 0) return;
  std::vector<unsigned> shared;  // of each new vertex
  for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
    const aiFace& face = mesh.mFaces[i];
    for (unsigned k = 0; k < face.mNumIndices; ++k) {
      shared.push_back(face.mIndices[k]);
      face.mIndices[k] = static_cast<unsigned>(shared.size() - 1);
    }
  }
  const auto split = [&]<class T>(T*& values) {
    if (values == nullptr) return;
    T* const own = new T[shared.size()];
    for (std::size_t i = 0; i < shared.size(); ++i) own[i] = values[shared[i]];
    delete[] std::exchange(values, own);
  };
  split(mesh.mVertices);
  split(mesh.mTangents);
  split(mesh.mBitangents);
  for (aiVector3D*& uvs : mesh.mTextureCoords) split(uvs);
  for (aiColor4D*& colors : mesh.mColors) split(colors);
  mesh.mNumVertices = static_cast<unsigned>(shared.size());
}

bool write_all(const void* data, std::size_t size) {
  return std::fwrite(data, 1, size, stdout) == size && std::fflush(stdout) == 0;
}

int fail(const std::string& reason) {
  std::fprintf(stderr, "%s\n", reason.c_str());
  return EXIT_FAILURE;
}

int convert(const std::string& file) {
  Assimp::Importer importer;
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  constexpr float sharp_edge = 40;  // degrees; of models without normals
  importer.SetPropertyFloat(AI_CONFIG_PP_GSN_MAX_SMOOTHING_ANGLE, sharp_edge);
  const aiScene* scene = importer.ReadFile(file, static_cast<unsigned>(aiProcess_Triangulate) | aiProcess_SortByPType);
  if (scene == nullptr) return fail(importer.GetErrorString());
  for (unsigned i = 0; i < scene->mNumMeshes; ++i) split_faces(*scene->mMeshes[i]);
  scene = importer.ApplyPostProcessing(aiProcess_GenSmoothNormals);  // the exporter joins vertices
  if (scene == nullptr) return fail(importer.GetErrorString());
  if (scene->mNumMeshes == 0) return fail("it has no mesh");
  aiScene& changed = *importer.GetOrphanedScene();  // nobody frees it: the process ends
  find_textures(changed, file);
  drop_third_coordinates(changed);
  if (has_z_up(file)) turn_y_up(changed);
  Assimp::Exporter exporter;
  const aiExportDataBlob* blob = exporter.ExportToBlob(&changed, "glb2");
  if (blob == nullptr && changed.mNumAnimations > 0) {
    changed.mNumAnimations = 0;  // better at rest than not at all
    blob = exporter.ExportToBlob(&changed, "glb2");
  }
  if (blob == nullptr) return fail(exporter.GetErrorString());
  return write_all(blob->data, blob->size) ? EXIT_SUCCESS : fail("the result cannot be written");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return fail("usage: raytrace-convert FILE BYTES");
  set_limits(std::strtoull(argv[2], nullptr, 10));
  int code = EXIT_FAILURE;
  try {
    code = convert(argv[1]);
  } catch (const std::bad_alloc&) {
    fail("it needs more memory than there is");
  } catch (const std::exception& error) {
    fail(error.what());
  }
  std::fflush(stderr);
  _exit(code);  // whatever the library would do at its end
}
