#include "common/linalg/share.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "common/linalg/own_rows.hpp"
#include "tests/linalg/thread_team.hpp"

namespace tether {
namespace {

using Edges = std::vector<std::array<int, 4>>;

/// The squares of a sheet of n x n nodes.
Edges squares(int n) {
  Edges all;
  for (int i = 0; i + 1 < n; ++i)
    for (int j = 0; j + 1 < n; ++j) all.push_back({i * n + j, i * n + j + 1, (i + 1) * n + j, (i + 1) * n + j + 1});
  return all;
}

SparseMatrix graph(int n) {
  const Edges all = squares(n);
  return ScatterMap(n * n, 1, std::span<const std::array<int, 4>>(all)).zero_matrix();
}

std::vector<int> sheet_in_parts(int n, int parts) {
  return cut_graph(graph(n), std::vector<int>(static_cast<std::size_t>(n * n), 1), parts);
}

/// A matrix of the sheet whose entries differ, as far as the elements give it.
SparseMatrix assembled(int n, const Edges& elements) {
  const ScatterMap map(n * n, 1, std::span<const std::array<int, 4>>(elements));
  SparseMatrix matrix = map.zero_matrix();
  for (std::size_t e = 0; e < elements.size(); ++e) {
    std::array<double, 16> block{};
    for (std::size_t k = 0; k < 16; ++k)
      block[k] = 1 + 0.1 * elements[e][k / 4] + 0.01 * elements[e][k % 4] + (k / 4 == k % 4 ? 20.0 * n : 0.0);
    map.add(matrix, e, block.data());
  }
  return matrix;
}

TEST(Share, PartsOfASheetAreAlikeAndTouchAlongAFewLines) {
  constexpr int n = 30, parts = 4;
  const std::vector<int> owner = sheet_in_parts(n, parts);
  std::vector<int> sizes(parts, 0);
  for (const int rank : owner) ++sizes.at(static_cast<std::size_t>(rank));
  for (const int size : sizes) EXPECT_NEAR(size, n * n / parts, 0.05 * n * n / parts);
  int cut = 0;
  for (const auto& [a, b, c, d] : squares(n))
    cut += std::set{owner[a], owner[b], owner[c], owner[d]}.size() > 1 ? 1 : 0;
  EXPECT_LT(cut, 3 * n);  // straight cuts into four take 2 n
}

TEST(Share, CompletesAFieldFromWhatEachHasOfIt) {
  constexpr int n = 7;
  in_team(3, [](Team& team) {
    const Share share(team, sheet_in_parts(n, 3));
    Points field = Points::Constant(3, n * n, -1);
    for (const int node : share.own()) field.col(node) << node, 10 * node, 100 * node;
    share.complete(field);
    for (int node = 0; node < n * n; ++node) EXPECT_EQ(field.col(node), Vec3(node, 10 * node, 100 * node));
  });
}

TEST(Share, AloneItIsWholeAndChangesNothing) {
  const Share share(5);
  VectorXd field = VectorXd::LinSpaced(5, 0, 4);
  share.complete(field);
  EXPECT_TRUE(share.is_whole());
  EXPECT_TRUE(share.is_own(3));
  EXPECT_EQ(field, VectorXd::LinSpaced(5, 0, 4));
  EXPECT_EQ(share.elements_here(squares(2)).size(), 1U);
}

TEST(Share, EachElementIsAnsweredForOnceAndOwnRowsAreWhole) {
  constexpr int n = 12;
  const Edges all = squares(n);
  const SparseMatrix whole = assembled(n, all);
  in_team(4, [&](Team& team) {
    const Share share(team, sheet_in_parts(n, 4));
    Edges here;
    double answered = 0;
    for (const int number : share.elements_here(all)) {
      here.push_back(all[static_cast<std::size_t>(number)]);
      answered += share.answers_for(here.back()) ? 1 : 0;
    }
    EXPECT_EQ(team.sum(answered), static_cast<double>(all.size()));
    const SparseMatrix mine = assembled(n, here);
    for (const int row : share.own()) EXPECT_LT((mine.row(row) - whole.row(row)).norm(), 1e-12);
  });
}

TEST(Share, RefusesMoreProcessesThanNodes) {
  in_team(3, [](Team& team) { EXPECT_THROW(Share(team, {0, 0, 1}), InputError); });
}

TEST(OwnRows, MultiplyAsTheWholeMatrixDoes) {
  constexpr int n = 12;
  const SparseMatrix whole = assembled(n, squares(n));
  Points field(3, n * n);
  for (int node = 0; node < n * n; ++node) field.col(node) << std::sin(node), std::cos(node), node;
  const Points expected = (whole * field.transpose()).transpose();
  in_team(4, [&](Team& team) {
    const Share share(team, sheet_in_parts(n, 4));
    OwnRows rows(share, whole);
    rows.take(whole);
    Points local = Points::Zero(3, rows.all());
    local.leftCols(rows.own()) = rows.own_of(field);
    rows.refresh(local);
    EXPECT_EQ(local, rows.all_of(field));
    const Points product = (rows.rows() * local.transpose()).transpose();
    Points result = Points::Zero(3, n * n);
    rows.put_back(product, result);
    share.complete(result);
    EXPECT_LT((result - expected).norm(), 1e-13 * expected.norm());
    EXPECT_EQ(rows.block().rows(), rows.own());
    EXPECT_EQ(rows.block().cols(), rows.own());
  });
}

TEST(Team, AllThrowWhatTheFirstThatFailedSays) {
  in_team(4, [](Team& team) {
    try {
      team.each([&] {
        if (team.rank() >= 2) throw run_error("of {}", team.rank());
      });
      ADD_FAILURE() << "nothing was thrown";
    } catch (const RunError& error) {
      EXPECT_STREQ(error.what(), "of 2");
    }
    team.each([] {});
  });
}

TEST(Team, LeastOverlooksNothingThatIsNoNumber) {
  in_team(3, [](Team& team) {
    EXPECT_EQ(team.least(3.0 - team.rank()).rank, 2);
    const double value = team.rank() == 1 ? std::numeric_limits<double>::quiet_NaN() : 1.0;
    EXPECT_EQ(team.least(value).rank, 1);
  });
  EXPECT_EQ(alone().least(4.0).value, 4.0);
}

}  // namespace
}  // namespace tether
