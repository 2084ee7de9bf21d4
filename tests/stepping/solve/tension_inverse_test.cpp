#include "bie/stepping/solve/tension_inverse.hpp"

#include <boost/test/unit_test.hpp>

#include "bie/physics/effects/tension.hpp"
#include "bie/stepping/solve/sphere_spectrum.hpp"
#include "tests/support/membrane.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

BOOST_AUTO_TEST_SUITE(tension_inverse)

BOOST_AUTO_TEST_CASE(takes_the_response_of_a_tension_back_to_it) {
  const int order = 12;
  const Space space(order);
  const TensionGrid grid(order);
  for (const double ratio : {1.0, 4.0}) {
    const Membrane membrane = make_membrane(space, asymmetric_shape(order), kStokesLayers, ratio);
    const FlowParameters parameters{1.7, ratio, true, {}};
    const double mean_response = uniform_tension_response(membrane.radius, parameters.viscosity, ratio);
    const std::vector<Index> entries = membrane.subspace.scalars();
    const TensionInverse inverse({parameters, membrane}, grid, entries, mean_response);
    const Vector tension = smooth_coefficients(order, 5, 1, 9);
    const std::vector<FlowMembrane> alone{{parameters, membrane}};
    const Interaction none;
    const Matrix force = tension_force(membrane, tension);
    const Matrix velocity = MembraneFlow(alone, none).velocities({membrane.weighted(force)}).front();
    const Vector response = weighted_divergence(membrane, membrane.fine.synthesize_gradient(velocity));
    const Vector found = inverse.apply(response(entries));
    BOOST_TEST(relative_difference(found, Vector(tension(entries))) < 1e-2);
  }
}

BOOST_AUTO_TEST_SUITE_END()
