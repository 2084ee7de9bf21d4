#pragma once

#include <vector>

/// Where one cell ends and the next begins along an edge of a block.
namespace vehd::meshes {

/// From −1 to 1, all cells of one length.
std::vector<double> even_breaks(int cells);

/// From 0 to 1, each layer `growth` times as thick as the one before.
std::vector<double> layer_breaks(int layers, double growth);

}  // namespace vehd::meshes
