#pragma once

#include "bie/fit/fit.hpp"
#include "bie/pictures/gnuplot.hpp"

namespace vehd {

/// Draws two panels for each experiment: the data with bars of one standard deviation and the model as a line; the
/// residuals in standard deviations. Contours are drawn over their angle φ, with one line for each frame.
/// @throws InputError if gnuplot is missing
void draw_fit(const FitFile& fit, const FitResult& result, const PictureFile& picture);

}  // namespace vehd
