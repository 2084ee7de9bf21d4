#pragma once

#include <filesystem>
#include <vector>

#include "bie/fit/experiment.hpp"
#include "bie/runs/sweep/sweep_runs.hpp"

namespace vehd {

/// Predictions of a finished run for its data, in SI base units if the scene has [units]: at the time of each datum, or
/// at the end of the run if the data are not against time.
/// @param directory  the runs are below it
/// @throws InputError if the run did not reach its end, or its files cannot be read
std::vector<double> values_of_run(const Experiment& experiment, const DataOfRun& data, const SweepRun& run,
                                  const std::filesystem::path& directory);

/// r(φ) of the section of a vesicle in the plane parallel to x and z through the centroid of its membrane: the distance
/// from the centroid to the outermost crossing in the direction (cos φ, 0, sin φ). φ is measured like
/// `inclination_deg`.
/// @param position  coefficients of x, [n_coefficients x 3]
/// @throws InputError if a ray misses the membrane
/// Accuracy: rounding, for the x of the given degree (tests/fit/contour_test.cpp)
std::vector<double> section_radii(const Matrix& position, const std::vector<double>& angles_deg);

}  // namespace vehd
