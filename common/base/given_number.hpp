#pragma once

/// Sizes of numbers in files of people's: what is outside is a slip or no number of anything, and would be told as inf
/// or nan of a later sum or quotient.
namespace tether {

/// Squares and cubes of these, sums of all that a file may hold, and a change of units stay finite.
inline constexpr double largest_given = 1e20;

/// Of what is not zero: quotients, and squares of them, stay finite.
inline constexpr double smallest_given = 1e-30;

}  // namespace tether
