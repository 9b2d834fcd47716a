#include "common/linalg/rounded_factor.hpp"

#include <cblas.h>
#include <cholmod.h>

#include <algorithm>
#include <array>
#include <cstring>

namespace tether {
namespace {

constexpr int widest = 64;  ///< columns of a panel: half of a triangle's square are zeros that are read as well

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
  for (int c = 0; c < columns; ++c) inverse[static_cast<std::size_t>(c * columns + c)] = 1;
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
      for (int c = 0; c < columns.size(); ++c)  // what is written never overtakes what is read
        for (int i = 0; i < columns.size() + below; ++i) {
          double value = 0;
          std::memcpy(&value, of_panel + static_cast<std::ptrdiff_t>(c) * node.height + i, sizeof value);
          const auto single = static_cast<float>(value);
          std::memcpy(values_ + size_++, &single, sizeof single);
        }
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
      cblas_sgemv(CblasColMajor, CblasNoTrans, height, columns.size(), 1, panel, height, solved.data(), 1, 1,
                  column + columns.begin, 1);
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
      cblas_sgemv(CblasColMajor, CblasTrans, height, columns.size(), 1, panel, height, column + columns.begin, 1, 0,
                  solved.data(), 1);
      std::copy_n(solved.begin(), columns.size(), column + columns.begin);
    }
    std::copy_n(column, node.columns, x + node.first);
  }
}

}  // namespace tether
