#include "option_synonyms.h"

#include <string>

namespace raytrace {

namespace {

struct Synonyms {
  std::string_view option;
  std::string_view words;  ///< between spaces, in lower case, without hyphens
};

constexpr Synonyms synonyms[] = {
    {"--spp",
     " samples sample samplesperpixel sampleperpixel pixelsamples nsamples numsamples samplecount aa aasamples "
     "antialias antialiasing quality "},
    {"--resolution",
     " size width height res hres vres imagesize image dimensions dimension picturesize outputsize filmsize filmwidth "
     "filmheight resolutionx resolutiony w x y "},
    {"--output",
     " out outfile outputfile outputimage outputpath imagefile imagename filename picture save write writeto "
     "renderoutput outputname "},
    {"--frames", " frame framerange range framelist startframe endframe start end anim animation f "},
    {"--threads",
     " cpus cpu cores jobs nthreads numthreads threadcount threadlimit workers nproc processors parallel j "},
    {"--crop", " region window cropwindow croprectangle cropregion roi border rect renderregion subregion "},
    {"--tile", " tiles part slice chunk bucket "},
    {"--define", " var variable variables set setvar param parameter parameters override declare def "},
    {"--isa", " simd arch instructionset vector avx avx2 avx512 sse "},
    {"--aov", " aovs channels channel passes pass layers layer renderelements "},
    {"--time-limit", " timeout maxtime time rendertime maxrendertime stoptime limit "},
    {"--resume", " continue restart recover "},
    {"--checkpoint", " snapshot autosave savestate checkpointfile "},
    {"--skip-existing", " skip nooverwrite keepexisting skiprendered "},
    {"--log-file", " log logfile logto "},
    {"--stats", " statistics statsfile profile timing timings "},
    {"--validate", " check dryrun lint noop parseonly test syntax n "},
    {"--print-scene", " print dump dumpscene toxml echo flatten "},
    {"--quiet", " silent noverbose quietly "},
    {"--verbose", " debug verbosity loglevel info "},
    {"--display-server", " display viewer preview tev show displaydriver interactive "},
    {"--bit-depth", " bits depth bpp bitdepth bitsperchannel "},
    {"--float", " full float32 fullfloat fp32 singleprecision half "},
    {"--transparent", " alpha nobackground background transparentbackground filmtransparent nosky "},
    {"--exposure", " ev gain brightness expose stops "},
    {"--scale", " percent percentage resize resolutionscale fraction "},
    {"--sample-offset", " offset firstsample startsample samplestart sampleoffset samplerange skipsamples "},
    {"--seed", " randomseed rngseed random "},
    {"--pixel", " debugpixel inspect xy "},
    {"--list", " shapes materials lights plugins formats types listtypes "},
    {"--version", " ver v "},
    {"--help", " usage man h ? "},
};

struct Letters {
  std::string_view start;
  std::string_view option;
};

constexpr Letters povray[] = {{"wt", "--threads"}, {"w", "--resolution"},    {"h", "--resolution"}, {"o", "--output"},
                              {"f", "--output"},   {"am", "--spp"},          {"a", "--spp"},        {"r", "--spp"},
                              {"sr", "--crop"},    {"er", "--crop"},         {"sc", "--crop"},      {"ec", "--crop"},
                              {"kf", "--frames"},  {"sf", "--frames"},       {"ef", "--frames"},    {"c", "--resume"},
                              {"v", "--verbose"},  {"d", "--display-server"}};

std::string plain(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '-' || c == '_' || c == '.' || c == '+') continue;
    result += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return result;
}

}  // namespace

std::string_view option_of_other_renderers(std::string_view name) {
  const std::string word = " " + plain(name) + " ";
  if (word.size() == 2) return {};
  for (const Synonyms& entry : synonyms)
    if (entry.words.find(word) != std::string_view::npos) return entry.option;
  return {};
}

std::string_view option_of_povray(std::string_view argument) {
  const std::string letters = plain(argument);
  for (const Letters& entry : povray)
    if (letters.starts_with(entry.start)) return entry.option;
  return {};
}

}  // namespace raytrace
