#include "raytrace/render/piece_layout.h"

#include <algorithm>
#include <set>

namespace raytrace {

namespace {

constexpr std::size_t most_problems = 20;

std::string text_of(const Region& r) {
  return std::to_string(r.x0) + "," + std::to_string(r.y0) + "," + std::to_string(r.x1) + "," + std::to_string(r.y1);
}

std::string samples_text(std::uint64_t first, std::uint64_t last) {
  return last - first == 1 ? "sample " + std::to_string(first)
                           : "samples " + std::to_string(first) + " to " + std::to_string(last - 1);
}

bool overlap(const PieceExtent& a, const PieceExtent& b) {
  return a.region.x0 < b.region.x1 && b.region.x0 < a.region.x1 && a.region.y0 < b.region.y1 &&
         b.region.y0 < a.region.y1 && a.first_sample < b.last_sample && b.first_sample < a.last_sample;
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

}  // namespace

std::vector<std::string> overlaps(const std::vector<PieceExtent>& pieces) {
  std::vector<std::string> problems;
  if (pieces.empty()) return problems;
  int top = pieces.front().region.y0, bottom = top;
  for (const PieceExtent& piece : pieces) {
    top = std::min(top, piece.region.y0);
    bottom = std::max(bottom, piece.region.y1);
  }
  std::set<std::pair<const PieceExtent*, const PieceExtent*>> told;
  for_each_strip(pieces, top, bottom, [&](int, int, std::vector<const PieceExtent*> present) {
    // Along a strip, or along the samples: whichever way tells more pieces apart.
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
        if (overlap(*present[i], **k) && told.insert(std::minmax(present[i], *k)).second)
          problems.push_back((*k)->file + " holds what " + present[i]->file + " holds, too");
        ++k;
      }
  });
  return problems;
}

std::vector<std::string> gaps(const std::vector<PieceExtent>& pieces, const Region& whole, std::uint64_t samples) {
  std::vector<std::string> problems;
  const auto tell = [&](const Region& region, std::uint64_t first, std::uint64_t last) {
    if (problems.size() < most_problems)
      problems.push_back("no piece holds " + samples_text(first, last) + " of the pixels " + text_of(region));
  };
  for_each_strip(pieces, whole.y0, whole.y1, [&](int top, int bottom, const std::vector<const PieceExtent*>& present) {
    std::set<int> columns = {whole.x0, whole.x1};
    for (const PieceExtent* piece : present)
      for (const int edge : {piece->region.x0, piece->region.x1})
        if (edge > whole.x0 && edge < whole.x1) columns.insert(edge);
    for (auto left = columns.begin(); std::next(left) != columns.end(); ++left) {
      std::vector<const PieceExtent*> here;
      for (const PieceExtent* piece : present)
        if (piece->region.x0 <= *left && piece->region.x1 > *left) here.push_back(piece);
      std::sort(here.begin(), here.end(),
                [](const auto* a, const auto* b) { return a->first_sample < b->first_sample; });
      std::uint64_t covered = 0;
      const Region region{*left, top, *std::next(left), bottom};
      for (const PieceExtent* piece : here) {
        if (piece->first_sample > covered) tell(region, covered, piece->first_sample);
        covered = std::max(covered, piece->last_sample);
      }
      if (covered < samples) tell(region, covered, samples);
    }
  });
  return problems;
}

}  // namespace raytrace
