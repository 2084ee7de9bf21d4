#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bie/pictures/gnuplot.hpp"
#include "bie/pictures/sweep_rows.hpp"

namespace vehd {

/// Mean of a column over runs that differ only in a seed.
struct SweepMean {
  std::vector<std::string> values;  ///< of the other keys, in their order
  int n_runs = 0;                   ///< completed runs that have a number
  double mean = 0.0;                ///< NaN without runs
  double error = 0.0;               ///< standard error of the mean; NaN of fewer than two runs
};

/// Index of the key of a sweep that is a seed of random numbers, if there is one.
std::optional<std::size_t> seed_key(const SweepRows& rows);

/// Means over the seed for all combinations of the other keys, in the order of the rows.
std::vector<SweepMean> means_over_seeds(const SweepRows& rows, std::size_t seed, std::size_t column);

/// Draws the means of columns against the first other key, with bars of one standard error and a line for each value of
/// the second one, and writes the drawn values to a table beside the picture.
/// @return paths of the picture and of the table
/// @throws InputError if there is no other key, or more than two
std::vector<std::filesystem::path> draw_sweep_means(const SweepRows& rows, std::size_t seed,
                                                    const std::vector<std::size_t>& columns,
                                                    const PictureFile& picture);

}  // namespace vehd
