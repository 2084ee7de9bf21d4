#include "tests/app/check_damages.hpp"

// The finite elements run one process on each processor.
BOOST_AUTO_TEST_SUITE(check_undulations, *boost::unit_test::precondition(finite_elements_are_built) *
                                             boost::unit_test::label("slow") * boost::unit_test::label("once"))

namespace {

const std::string scene_text =
    "[shape]\nkind = 'ellipsoid'\naxes = [1.3, 1.1, 0.9]\nrotation = [0.3, 1.0, 0.2, 35.0]\n"
    "[membrane]\nbending_modulus = 0.1\nundulations = true\ntemperature = 0.02\nstretching_modulus = 20.0\n"
    "reference_tension = 0.5\n"
    "[flow]\nkind = 'shear'\nrate = 1.0\n"
    "[numerics]\norder = 10\ntime_order = 2\ndt = 0.1\nend_time = 0.2\n[output]\nevery = 0.2\n";

}  // namespace

// The elements take the dilation from the boundary integrals and must find the mean tension.
BOOST_AUTO_TEST_CASE(tension_and_dilation_are_those_of_the_elements_and_damage_is_noticed) {
  const FinishedRun run(scene_text);
  check_and_damage(run, "0.2", {"velocity"}, {"force_tension_work", "tension", "velocity", "surface_divergence"},
                   {state_with(
                        "mean tension", [](FrozenState& s) { s.model.vesicles[0].undulations->rest_area *= 0.999; },
                        "from_shape", "tension"),
                    {"stored tension", [](CheckNumbers& n) { n.problem.frozen.fields.vesicles[0].tension *= 1.02; },
                     "stored", "tension"}});
}

BOOST_AUTO_TEST_SUITE_END()
