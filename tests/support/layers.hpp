#pragma once

#include <array>
#include <utility>

#include "bie/geometry/surface.hpp"
#include "bie/potentials/layer_operators.hpp"
#include "bie/stepping/space/discretisation.hpp"

namespace vehd::testing {

/// Tables of one order, with the program's default settings unless others are given.
struct Space {
  SphereTransform coarse;
  SphereTransform fine;
  RotatedQuadrature quadrature;

  explicit Space(int order, int upsampling = NumericalSettings{}.upsampling,
                 double oversampling = NumericalSettings{}.quadrature_oversampling)
      : coarse(order, make_grid(order)),
        fine(order, make_grid(upsampling * order)),
        quadrature(make_rotated_quadrature(coarse.grid(), oversampling)) {}
};

constexpr LayerSelection kLaplaceLayers{true, true, true, false};
constexpr LayerSelection kStokesLayer{false, false, false, true};
constexpr LayerSelection kStokesLayers{.stokes_single = true, .stokes_double = true};
constexpr LayerSelection kAllLayers{true, true, true, true};

/// All kernels of an assembly, on weighted and on plain densities.
inline constexpr std::array kEveryKernel{LayerSelection{true, true, true, true, true, true, false},
                                         LayerSelection{true, true, true, true, true, true, true}};
inline constexpr std::array kScalarLayers{&LayerOperators::laplace_single, &LayerOperators::laplace_double,
                                          &LayerOperators::laplace_adjoint, &LayerOperators::laplace_hypersingular};
inline constexpr std::array kVectorLayers{&LayerOperators::stokes_single, &LayerOperators::stokes_double};

inline LayerOperators assemble(const Space& space, const Matrix& position, const LayerSelection& selection) {
  Instruments instruments;
  return assemble_layer_operators(space.quadrature, space.coarse, position, selection, instruments);
}

/// A surface with some of its layers.
struct LayeredSurface {
  Space space;
  Matrix position;
  Surface surface;
  LayerOperators layers;

  LayeredSurface(int order, Matrix coefficients, const LayerSelection& selection)
      : space(order),
        position(std::move(coefficients)),
        surface(make_surface(space.fine, position)),
        layers(assemble(space, position, selection)) {}
};

/// Coefficients of J f, from values of f on the fine grid.
inline Matrix weighted(const Space& space, const Surface& surface, const Matrix& values) {
  return space.fine.analyze(surface.area_element.asDiagonal() * values);
}

}  // namespace vehd::testing
