#pragma once

#include <vector>

/// Boundaries between cells along an edge of a block.
namespace vehd::meshes {

/// Breaks from −1 to 1 with cells of equal length.
std::vector<double> even_breaks(int cells);

/// Breaks from 0 to 1, each layer `growth` times as thick as the previous one.
std::vector<double> layer_breaks(int layers, double growth);

}  // namespace vehd::meshes
