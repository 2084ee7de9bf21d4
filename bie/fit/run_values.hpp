#pragma once

#include <filesystem>
#include <vector>

#include "bie/fit/experiment.hpp"
#include "bie/runs/sweep/sweep_runs.hpp"

namespace vehd {

/// Predictions of a finished run for its data, in SI base units where the scene has [units]: at the time of each datum,
/// or at the end of the run.
/// @param directory  the runs are below it
/// @throws InputError if the run did not reach its end, or its files cannot be read
std::vector<double> values_of_run(const Experiment& experiment, const DataOfRun& data, const SweepRun& run,
                                  const std::filesystem::path& directory);

/// r(φ) of the section of a vesicle in the plane through the centroid of its membrane that is parallel to x and z: the
/// distance from there to the outermost crossing in the direction (cos φ, 0, sin φ). φ is the angle of
/// `inclination_deg`.
/// @param position  coefficients of x, [n_coefficients x 3]
/// @throws InputError where the ray meets no membrane
/// Accuracy: rounding, of the x that is given (tests/fit/contour_test.cpp)
std::vector<double> section_radii(const Matrix& position, const std::vector<double>& angles_deg);

}  // namespace vehd
