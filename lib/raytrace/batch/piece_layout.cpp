#include "raytrace/batch/piece_layout.h"

#include <algorithm>
#include <set>
#include <tuple>
#include <utility>

namespace raytrace {

namespace {

constexpr std::size_t most_problems = 20;

std::string samples_text(std::uint64_t first, std::uint64_t last) {
  return last - first == 1 ? "sample " + std::to_string(first)
                           : "samples " + std::to_string(first) + " to " + std::to_string(last - 1);
}

bool overlap(const Region& a, const Region& b) { return a.x0 < b.x1 && b.x0 < a.x1 && a.y0 < b.y1 && b.y0 < a.y1; }

bool overlap(const PieceExtent& a, const PieceExtent& b) {
  return overlap(a.region, b.region) && a.first_sample < b.last_sample && b.first_sample < a.last_sample;
}

/// Calls visit(top, bottom, pieces) for strips of rows from the top, in each of which the same pieces lie.
template <class Visit>
void for_each_strip(const std::vector<PieceExtent>& pieces, int top, int bottom, const Visit& visit) {
  std::vector<const PieceExtent*> by_top;
  std::set<int> edges = {top, bottom};
  for (const PieceExtent& piece : pieces) {
    by_top.push_back(&piece);
    for (const int edge : {piece.region.y0, piece.region.y1})
      if (edge > top && edge < bottom) edges.insert(edge);
  }
  std::sort(by_top.begin(), by_top.end(), [](const auto* a, const auto* b) { return a->region.y0 < b->region.y0; });
  std::vector<const PieceExtent*> present;
  auto next = by_top.begin();
  for (auto edge = edges.begin(); std::next(edge) != edges.end(); ++edge) {
    std::erase_if(present, [&](const PieceExtent* piece) { return piece->region.y1 <= *edge; });
    for (; next != by_top.end() && (*next)->region.y0 <= *edge; ++next)
      if ((*next)->region.y1 > *edge) present.push_back(*next);
    visit(*edge, *std::next(edge), present);
  }
}

/// Calls visit(gap) for boxes of pixels and samples that no piece holds, until it returns false.
template <class Visit>
void for_each_gap(const std::vector<PieceExtent>& pieces, const WantedExtent& picture, const Visit& visit) {
  const Region& whole = picture.region;
  bool more = true;
  for_each_strip(pieces, whole.y0, whole.y1, [&](int top, int bottom, const std::vector<const PieceExtent*>& present) {
    std::set<int> columns = {whole.x0, whole.x1};
    for (const PieceExtent* piece : present)
      for (const int edge : {piece->region.x0, piece->region.x1})
        if (edge > whole.x0 && edge < whole.x1) columns.insert(edge);
    for (auto left = columns.begin(); more && std::next(left) != columns.end(); ++left) {
      std::vector<const PieceExtent*> here;
      for (const PieceExtent* piece : present)
        if (piece->region.x0 <= *left && piece->region.x1 > *left) here.push_back(piece);
      std::sort(here.begin(), here.end(),
                [](const auto* a, const auto* b) { return a->first_sample < b->first_sample; });
      const Region region{*left, top, *std::next(left), bottom};
      std::uint64_t covered = 0;
      for (const PieceExtent* piece : here) {
        if (piece->first_sample > covered) more = more && visit(PieceExtent{"", region, covered, piece->first_sample});
        covered = std::max(covered, piece->last_sample);
      }
      if (covered < picture.samples) more = more && visit(PieceExtent{"", region, covered, picture.samples});
    }
  });
}

/// The tiles that a picture may be cut into so that each of its pieces holds whole ones of them.
class Cuts {
 public:
  Cuts(const std::vector<PieceExtent>& pieces, const Region& whole) : pieces_(pieces) {
    std::set<int> counts = {1};
    for (const PieceExtent& piece : pieces)
      if (piece.tile) counts.insert(piece.tile->count);
    for (const int count : counts)
      for (int index = 0; index < count; ++index) tiles_.push_back({{index, count}, tile_of(whole, index, count)});
  }

  /// Pieces of no samples, which cut gaps along the edges of tiles.
  std::vector<PieceExtent> edges() const {
    std::vector<PieceExtent> edges;
    for (const auto& [tile, region] : tiles_) edges.push_back({"", region, 0, 0});
    return edges;
  }

  /// The gap, widened to the tile that it is in: the largest of which all lacks the same samples. None if there is
  /// none.
  std::optional<PieceExtent> tile_around(const PieceExtent& gap) const {
    for (const auto& [tile, region] : tiles_) {
      const auto is_cut = [&, &area = region](const PieceExtent& piece) {
        return overlap(piece.region, area) && !contains(piece.region, area);
      };
      if (contains(region, gap.region) && std::none_of(pieces_.begin(), pieces_.end(), is_cut))
        return PieceExtent{"", region, gap.first_sample, gap.last_sample, tile};
    }
    return std::nullopt;
  }

 private:
  const std::vector<PieceExtent>& pieces_;
  std::vector<std::pair<Tile, Region>> tiles_;
};

/// "tile 2/4 is missing: render it with --tile 2/4 -s 16"
std::string problem_of(const PieceExtent& part, const WantedExtent& picture) {
  const Tile& tile = *part.tile;
  const bool all_samples = part.first_sample == 0 && part.last_sample == picture.samples;
  const std::string name = "tile " + std::to_string(tile.index) + "/" + std::to_string(tile.count);
  std::string text = all_samples ? name : samples_text(part.first_sample, part.last_sample);
  if (!all_samples && tile.count > 1) text += " of " + name;
  const std::uint64_t count = part.last_sample - part.first_sample;
  const bool one = all_samples || count == 1;
  text += one ? " is missing: render it with" : " are missing: render them with";
  if (tile.count > 1) text += " --tile " + std::to_string(tile.index) + "/" + std::to_string(tile.count);
  // A single sample would be in the pixel's center without it.
  if (!all_samples || (count == 1 && !picture.centered))
    text += " --sample-offset " + std::to_string(part.first_sample);
  text += " -s " + std::to_string(count);
  return text + (picture.crop.empty() ? "" : " --crop=" + picture.crop);
}

}  // namespace

std::string options_of(const PieceExtent& piece) {
  std::string options;
  if (piece.tile)
    options += "--tile " + std::to_string(piece.tile->index) + "/" + std::to_string(piece.tile->count) + " ";
  if (piece.first_sample > 0) options += "--sample-offset " + std::to_string(piece.first_sample) + " ";
  return options;
}

std::vector<std::string> overlaps(const std::vector<PieceExtent>& pieces) {
  std::vector<std::string> problems;
  if (pieces.empty()) return problems;
  int top = pieces.front().region.y0, bottom = top;
  for (const PieceExtent& piece : pieces) {
    top = std::min(top, piece.region.y0);
    bottom = std::max(bottom, piece.region.y1);
  }
  std::set<std::pair<const PieceExtent*, const PieceExtent*>> reported;
  for_each_strip(pieces, top, bottom, [&](int, int, std::vector<const PieceExtent*> present) {
    // Along a strip, or along the samples: whichever way separates more pieces.
    std::sort(present.begin(), present.end(), [](const auto* a, const auto* b) {
      return std::tie(a->first_sample, a->region.x0) < std::tie(b->first_sample, b->region.x0);
    });
    for (std::size_t i = 0; i < present.size() && problems.size() < most_problems; ++i)
      for (auto k = present.begin() + static_cast<std::ptrdiff_t>(i) + 1;
           k != present.end() && (*k)->first_sample < present[i]->last_sample && problems.size() < most_problems;) {
        if ((*k)->region.x0 >= present[i]->region.x1) {
          // So are all others that begin with this sample.
          k = std::upper_bound(k, present.end(), (*k)->first_sample,
                               [](std::uint64_t sample, const auto* piece) { return sample < piece->first_sample; });
          continue;
        }
        if (overlap(*present[i], **k) && reported.insert(std::minmax(present[i], *k)).second)
          problems.push_back((*k)->file + " holds what " + present[i]->file + " holds, too");
        ++k;
      }
  });
  return problems;
}

std::vector<std::string> missing_parts(const std::vector<PieceExtent>& pieces, const WantedExtent& picture) {
  std::vector<std::string> problems;
  bool complete = true;
  for_each_gap(pieces, picture, [&](const PieceExtent&) { return complete = false; });
  if (complete) return problems;
  const Cuts cuts(pieces, picture.region);
  std::vector<PieceExtent> all = cuts.edges(), reported;
  all.insert(all.end(), pieces.begin(), pieces.end());
  for_each_gap(all, picture, [&](const PieceExtent& gap) {
    const bool is_reported = std::any_of(reported.begin(), reported.end(), [&](const PieceExtent& part) {
      return contains(part.region, gap.region) && part.first_sample == gap.first_sample;
    });
    if (is_reported) return true;
    if (const auto part = cuts.tile_around(gap)) {
      reported.push_back(*part);
      problems.push_back(problem_of(*part, picture));
    } else {
      problems.push_back("no piece holds " + samples_text(gap.first_sample, gap.last_sample) + " of the pixels " +
                         text_of(gap.region) + ": render the tiles of one cut, --tile I/N with the same N");
    }
    return problems.size() < most_problems;
  });
  return problems;
}

}  // namespace raytrace
