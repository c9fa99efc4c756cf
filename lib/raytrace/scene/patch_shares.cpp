#include "raytrace/scene/patch_shares.h"

#include <numeric>

#include "raytrace/math/gather.h"

namespace raytrace {

namespace {

/// 0, then the numbers added up, as parts of their sum: the last is 1.
void add_shares(std::span<const double> numbers, std::vector<float>& shares) {
  const double whole = std::accumulate(numbers.begin(), numbers.end(), 0.0);
  double sum = 0;
  shares.push_back(0);
  for (std::size_t i = 0; i + 1 < numbers.size(); ++i)
    shares.push_back(static_cast<float>((sum += numbers[i]) / whole));
  shares.push_back(1);
}

}  // namespace

void PatchShares::add(std::span<const float> radiances) {
  firsts_.push_back(radiances.empty() ? -1 : static_cast<std::int32_t>(shares_.size()));
  if (radiances.empty()) return;
  const auto cells = static_cast<std::size_t>(cells_);
  const std::vector<double> numbers(radiances.begin(), radiances.end());
  std::vector<double> columns;
  for (auto column = numbers.begin(); column != numbers.end(); column += cells_)
    columns.push_back(std::accumulate(column, column + cells_, 0.0));
  add_shares(columns, shares_);
  for (std::size_t column = 0; column < cells; ++column)
    add_shares(std::span(numbers).subspan(column * cells, cells), shares_);
}

MaskN PatchShares::uneven(const IntN& patch) const {
  return float_mask<FloatN>(gather(firsts_.data(), patch) >= IntN(0));
}

IntN PatchShares::first(const IntN& patch) const {
  const IntN first = gather(firsts_.data(), patch);
  return select_lanes(float_mask<FloatN>(first >= IntN(0)), first, IntN(0));
}

FloatN PatchShares::share_of(const IntN& first, const IntN& cell) const {
  const IntN place = first + cell;
  return gather(shares_.data() + 1, place) - gather(shares_.data(), place);
}

IntN PatchShares::pick(const IntN& first, FloatN& u, FloatN& share) const {
  IntN cell(0);
  for (std::int32_t half = cells_ / 2; half > 0; half /= 2)
    cell = select_lanes(u >= gather(shares_.data() + half, first + cell), cell + IntN(half), cell);
  share = share_of(first, cell);
  u = min((u - gather(shares_.data(), first + cell)) / share, FloatN(0x1.fffffep-1F));
  return cell;
}

PatchShares::Draw PatchShares::draw(const IntN& patch, FloatN u1, FloatN u2) const {
  const FloatN edge(1 / static_cast<float>(cells_));
  FloatN share1, share2;
  const IntN columns = first(patch), column = pick(columns, u1, share1);
  const IntN cell = pick(columns + (column + IntN(1)) * IntN(cells_ + 1), u2, share2);
  return {{(to_float(column) + u1) * edge, (to_float(cell) + u2) * edge},
          share1 * share2 * FloatN(static_cast<float>(cells_ * cells_))};
}

IntN PatchShares::cell_of(const FloatN& u) const {
  const auto cells = static_cast<float>(cells_);
  return to_int(min(max(u, FloatN(0)) * FloatN(cells), FloatN(cells - 0.5F)));
}

FloatN PatchShares::density(const IntN& patch, const Vec2<FloatN>& square) const {
  const IntN columns = first(patch), column = cell_of(square.x);
  return share_of(columns, column) * share_of(columns + (column + IntN(1)) * IntN(cells_ + 1), cell_of(square.y)) *
         FloatN(static_cast<float>(cells_ * cells_));
}

}  // namespace raytrace
