#pragma once

#include "bie/fit/fit.hpp"
#include "bie/pictures/gnuplot.hpp"

namespace vehd {

/// Draws two panels for each experiment: the data with bars of one standard deviation and the model as a line, and
/// beside it the differences in deviations. Contours stand at the values of their abscissa by their angle φ.
/// @throws InputError if gnuplot is missing
void draw_fit(const FitFile& fit, const FitResult& result, const PictureFile& picture);

}  // namespace vehd
