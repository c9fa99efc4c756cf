#include "raytrace/batch/piece_layout.h"

#include <algorithm>
#include <iterator>
#include <set>
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

using Pieces = std::vector<const PieceExtent*>;

/// The edges of pieces along an axis, from the first to the last of a picture's.
std::set<int> edges_in(const Pieces& pieces, const Region& whole, int Region::* low, int Region::* high) {
  std::set<int> edges = {whole.*low, whole.*high};
  for (const PieceExtent* piece : pieces)
    for (const int edge : {piece->region.*low, piece->region.*high})
      if (edge > whole.*low && edge < whole.*high) edges.insert(edge);
  return edges;
}

/// Those that hold the pixels behind an edge.
Pieces pieces_at(const Pieces& pieces, int edge, int Region::* low, int Region::* high) {
  Pieces found;
  std::copy_if(pieces.begin(), pieces.end(), std::back_inserter(found),
               [&](const PieceExtent* piece) { return piece->region.*low <= edge && piece->region.*high > edge; });
  return found;
}

/// Calls visit(gap) for boxes of pixels and samples that no piece holds, until it returns false.
template <class Visit>
void for_each_gap(const std::vector<PieceExtent>& pieces, const WantedExtent& picture, const Visit& visit) {
  Pieces all;
  for (const PieceExtent& piece : pieces) all.push_back(&piece);
  const std::set<int> rows = edges_in(all, picture.region, &Region::y0, &Region::y1);
  for (auto top = rows.begin(); std::next(top) != rows.end(); ++top) {
    const Pieces strip = pieces_at(all, *top, &Region::y0, &Region::y1);
    const std::set<int> columns = edges_in(strip, picture.region, &Region::x0, &Region::x1);
    for (auto left = columns.begin(); std::next(left) != columns.end(); ++left) {
      Pieces here = pieces_at(strip, *left, &Region::x0, &Region::x1);
      std::sort(here.begin(), here.end(),
                [](const auto* a, const auto* b) { return a->first_sample < b->first_sample; });
      const Region region{*left, *top, *std::next(left), *std::next(top)};
      std::uint64_t covered = 0;
      for (const PieceExtent* piece : here) {
        if (piece->first_sample > covered && !visit(PieceExtent{"", region, covered, piece->first_sample})) return;
        covered = std::max(covered, piece->last_sample);
      }
      if (covered < picture.samples && !visit(PieceExtent{"", region, covered, picture.samples})) return;
    }
  }
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
  const std::string name = "tile " + text_of(tile);
  std::string text = all_samples ? name : samples_text(part.first_sample, part.last_sample);
  if (!all_samples && tile.count > 1) text += " of " + name;
  const std::uint64_t count = part.last_sample - part.first_sample;
  const bool one = all_samples || count == 1;
  text += one ? " is missing: render it with" : " are missing: render them with";
  if (tile.count > 1) text += " --tile " + text_of(tile);
  // A single sample would be in the pixel's center without it.
  if (!all_samples || (count == 1 && !picture.centered))
    text += " --sample-offset " + std::to_string(part.first_sample);
  text += " -s " + std::to_string(count);
  return text + (picture.crop.empty() ? "" : " --crop=" + picture.crop);
}

}  // namespace

std::string options_of(const PieceExtent& piece) {
  std::string options;
  if (piece.tile) options += "--tile " + text_of(*piece.tile) + " ";
  if (piece.first_sample > 0) options += "--sample-offset " + std::to_string(piece.first_sample) + " ";
  return options;
}

std::vector<std::string> overlaps(const std::vector<PieceExtent>& pieces) {
  Pieces by_top;
  for (const PieceExtent& piece : pieces) by_top.push_back(&piece);
  std::stable_sort(by_top.begin(), by_top.end(),
                   [](const auto* a, const auto* b) { return a->region.y0 < b->region.y0; });
  std::vector<std::string> problems;
  for (auto a = by_top.begin(); a != by_top.end(); ++a)
    for (auto b = std::next(a); b != by_top.end() && (*b)->region.y0 < (*a)->region.y1; ++b) {
      if (!overlap(**a, **b)) continue;
      const auto [first, second] = std::minmax(*a, *b);  // in the order that they were given in
      problems.push_back(second->file + " holds what " + first->file + " holds, too");
      if (problems.size() == most_problems) return problems;
    }
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
