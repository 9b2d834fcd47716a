#include "common/linalg/rounded_factor.hpp"

#include <cblas.h>
#include <cholmod.h>

#include <algorithm>
#include <array>
#include <cstring>

namespace tether {
namespace {

constexpr int widest = 64;  ///< columns of a panel: half of a triangle's square are zeros that are read as well
constexpr int lanes = 8;
constexpr int ahead = 1024;  ///< numbers, to be fetched in time: a new page is where the processor stops to look ahead
using Lanes [[gnu::vector_size(lanes * sizeof(float))]] = float;
using Anywhere [[gnu::vector_size(lanes * sizeof(float)), gnu::aligned(sizeof(float)), gnu::may_alias]] = float;

const Anywhere& at(const float* from) {
  return *reinterpret_cast<const Anywhere*>(from);
}
Anywhere& at(float* from) {
  return *reinterpret_cast<Anywhere*>(from);
}
float sum(const Lanes& all) {
  float half[4];
  for (int i = 0; i < 4; ++i) half[i] = all[i] + all[i + 4];
  return (half[0] + half[2]) + (half[1] + half[3]);
}

/// A panel as it lies in memory: as many rows at once as there are lanes, of those all columns one after the other;
/// then what rows are left, one after the other. A product with it reads straight on, as fast as memory gives.
struct Panel {
  const float* values;
  int height, columns;

  int whole() const { return height - height % lanes; }

  /// y <- y + A x
  void add_product(const float* x, float* y) const {
    const float* a = values;
    for (int row = 0; row < whole(); row += lanes) {
      Lanes sums[4] = {};
      int c = 0;
      for (; c + 4 <= columns; c += 4) {
        __builtin_prefetch(a + c * lanes + ahead);
        __builtin_prefetch(a + (c + 2) * lanes + ahead);
        for (int k = 0; k < 4; ++k) sums[k] += at(a + (c + k) * lanes) * x[c + k];
      }
      for (; c < columns; ++c) sums[0] += at(a + c * lanes) * x[c];
      at(y + row) += (sums[0] + sums[1]) + (sums[2] + sums[3]);
      a += columns * lanes;
    }
    for (int row = whole(); row < height; ++row, a += columns) {
      float of_row = 0;
      for (int c = 0; c < columns; ++c) of_row += a[c] * x[c];
      y[row] += of_row;
    }
  }
  /// x <- A'y
  void transposed_product(const float* y, float* x) const {
    Lanes sums[widest];
    for (int c = 0; c < columns; ++c) sums[c] = Lanes{};
    const float* a = values;
    int row = 0;
    for (; row + 2 * lanes <= height; row += 2 * lanes, a += 2 * columns * lanes) {
      const Lanes first = at(y + row), second = at(y + row + lanes);
      const float* b = a + columns * lanes;
      for (int c = 0; c < columns; ++c) {
        __builtin_prefetch(a + 2 * c * lanes + ahead);
        sums[c] += at(a + c * lanes) * first + at(b + c * lanes) * second;
      }
    }
    for (; row < whole(); row += lanes, a += columns * lanes) {
      const Lanes some = at(y + row);
      for (int c = 0; c < columns; ++c) sums[c] += at(a + c * lanes) * some;
    }
    for (int c = 0; c < columns; ++c) x[c] = sum(sums[c]);
    for (; row < height; ++row, a += columns)
      for (int c = 0; c < columns; ++c) x[c] += a[c] * y[row];
  }
};

/// A panel, given column by column, put down as above. to: may begin where the columns do.
void round_panel(const double* columns_of, std::ptrdiff_t stride, int height, int columns, std::vector<float>& room,
                 float* to) {
  room.resize(static_cast<std::size_t>(height) * static_cast<std::size_t>(columns));
  float* next = room.data();
  const auto value = [&](int row, int c) {
    double exact = 0;
    std::memcpy(&exact, columns_of + c * stride + row, sizeof exact);
    return static_cast<float>(exact);
  };
  const int whole = height - height % lanes;
  for (int row = 0; row < whole; row += lanes)
    for (int c = 0; c < columns; ++c)
      for (int i = 0; i < lanes; ++i) *next++ = value(row + i, c);
  for (int row = whole; row < height; ++row)
    for (int c = 0; c < columns; ++c) *next++ = value(row, c);
  std::memcpy(to, room.data(), room.size() * sizeof(float));
}

struct Span {
  int begin, end;
  int size() const { return end - begin; }
};

int panels_of(int columns) {
  return (columns + widest - 1) / widest;
}
Span panel_of(int columns, int k) {
  return {k * widest, std::min((k + 1) * widest, columns)};
}

/// A panel of a factor with columns of `height` numbers, from its diagonal on: T, then B below it, becomes T^-1 and
/// -B T^-1.
void invert(double* panel, int height, int columns, int below) {
  std::array<double, std::size_t{widest} * widest> inverse{};
  for (int c = 0; c < columns; ++c) inverse[static_cast<std::size_t>(c) * static_cast<std::size_t>(columns + 1)] = 1;
  cblas_dtrsm(CblasColMajor, CblasLeft, CblasLower, CblasNoTrans, CblasNonUnit, columns, columns, 1, panel, height,
              inverse.data(), columns);
  cblas_dtrmm(CblasColMajor, CblasRight, CblasLower, CblasNoTrans, CblasNonUnit, below, columns, -1, inverse.data(),
              columns, panel + columns, height);
  for (int c = 0; c < columns; ++c)
    std::copy_n(inverse.data() + c * columns, columns, panel + static_cast<std::ptrdiff_t>(c) * height);
}

}  // namespace

void RoundedFactor::take(cholmod_factor& factor, int end) {
  drop();
  auto* exact = static_cast<double*>(factor.x);
  values_ = static_cast<float*>(factor.x);
  room_ = factor.xsize;
  const int *super = static_cast<const int*>(factor.super), *places = static_cast<const int*>(factor.pi);
  rows_.assign(static_cast<const int*>(factor.s), static_cast<const int*>(factor.s) + factor.ssize);
  std::size_t tallest = 0;
  std::vector<float> room;
  for (std::size_t s = 0; s < factor.nsuper && super[s] < end; ++s) {
    const Panels node{super[s], std::min(super[s + 1], end) - super[s], places[s + 1] - places[s], nullptr, size_};
    supernodes_.push_back(node);
    supernodes_.back().rows = rows_.data() + places[s] + node.columns;
    tallest = std::max(tallest, static_cast<std::size_t>(node.height));
    for (int k = 0; k < panels_of(node.columns); ++k) {
      const Span columns = panel_of(node.columns, k);
      double* of_panel = exact + static_cast<const int*>(factor.px)[s] +
                         static_cast<std::ptrdiff_t>(columns.begin) * node.height + columns.begin;
      const int below = node.height - columns.end;
      invert(of_panel, node.height, columns.size(), below);
      round_panel(of_panel, node.height, columns.size() + below, columns.size(), room, values_ + size_);
      size_ += static_cast<std::size_t>(columns.size() + below) * static_cast<std::size_t>(columns.size());
    }
  }
  column_.resize(tallest);
  values_ = static_cast<float*>(cholmod_realloc(size_ / 2 + 1, 8, factor.x, &room_, &common_));
  factor.x = nullptr;  // as cholmod_change_factor leaves it, which would have freed the values
  factor.xtype = CHOLMOD_PATTERN;
}

void RoundedFactor::drop() {
  values_ = static_cast<float*>(cholmod_free(room_, 8, values_, &common_));
  room_ = size_ = 0;
  supernodes_.clear();
}

void RoundedFactor::solve_forward(float* x) const {
  float* const column = column_.data();
  std::array<float, widest> solved{};
  for (const Panels& node : supernodes_) {
    const float* panel = values_ + node.values;
    std::copy_n(x + node.first, node.columns, column);
    std::fill(column + node.columns, column + node.height, 0.0F);
    for (int k = 0; k < panels_of(node.columns); ++k) {
      const Span columns = panel_of(node.columns, k);
      const int height = node.height - columns.begin;
      std::copy_n(column + columns.begin, columns.size(), solved.begin());
      std::fill_n(column + columns.begin, columns.size(), 0.0F);
      Panel{panel, height, columns.size()}.add_product(solved.data(), column + columns.begin);
      panel += static_cast<std::ptrdiff_t>(height) * columns.size();
    }
    std::copy_n(column, node.columns, x + node.first);
    for (int i = 0; i < node.height - node.columns; ++i) x[node.rows[i]] += column[node.columns + i];
  }
}

void RoundedFactor::solve_backward(float* x) const {
  float* const column = column_.data();
  std::array<float, widest> solved{};
  for (std::size_t s = supernodes_.size(); s-- > 0;) {
    const Panels& node = supernodes_[s];
    const float* panel = values_ + (s + 1 < supernodes_.size() ? supernodes_[s + 1].values : size_);
    std::copy_n(x + node.first, node.columns, column);
    for (int i = 0; i < node.height - node.columns; ++i) column[node.columns + i] = x[node.rows[i]];
    for (int k = panels_of(node.columns); k-- > 0;) {
      const Span columns = panel_of(node.columns, k);
      const int height = node.height - columns.begin;
      panel -= static_cast<std::ptrdiff_t>(height) * columns.size();
      Panel{panel, height, columns.size()}.transposed_product(column + columns.begin, solved.data());
      std::copy_n(solved.begin(), columns.size(), column + columns.begin);
    }
    std::copy_n(column, node.columns, x + node.first);
  }
}

}  // namespace tether
