#include <boost/test/unit_test.hpp>
#include <cmath>

#include "bie/physics/effects/gravity.hpp"
#include "bie/stepping/evaluation/smallest_gap.hpp"
#include "bie/stepping/evaluation/volume_moments.hpp"
#include "bie/stepping/evolution.hpp"
#include "bie/stepping/thresholds.hpp"
#include "bie/support/errors.hpp"
#include "tests/support/beside_wall.hpp"
#include "tests/support/several_runs.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

BOOST_AUTO_TEST_SUITE(beside_wall)

namespace {

Wall floor_without_slip() { return {Vector3::Zero(), Vector3::UnitZ(), WallFlow::no_slip, WallField::none}; }

/// A unit sphere pulled by a force of 1.
Model pulled(const Vector3& direction, double viscosity, double ratio, const Wall& wall) {
  Model model = relaxation_model(0.1);
  model.viscosity = viscosity;
  model.wall = wall;
  const double volume = 4.0 / 3.0 * std::numbers::pi;
  model.vesicles.front().effects.push_back(
      std::make_shared<GravityEffect>(GravityParameters{1.0, direction.normalized() / volume}));
  model.vesicles.front().viscosity_ratio = ratio;
  return model;
}

Vector3 velocity_of(const Model& model, const Matrix& sphere_at, bool symmetric) {
  const std::vector<Matrix> spheres{sphere_at};
  NumericalSettings settings;
  settings.beside_wall = true;
  const Discretisation discretisation =
      discretisation_of(spheres, settings, symmetric ? find_symmetry(model, at_rest(spheres)) : Symmetry{});
  return translation(solved(model, discretisation, at_rest(spheres)).fields.vesicles[0].velocity);
}

Matrix height_above(const Matrix& position, double height) { return translated(position, {0.0, 0.0, height}); }

/// Relative differences of the speed of a vesicle away from the wall z = 0 from those of its stresslet S.
struct DriftErrors {
  double radii;    ///< height of the centroid over √(A/4π)
  double leading;  ///< from the image of the stresslet at the centroid, 9 S_zz/(64πμh²)
  double both;     ///< from that image averaged over the volume, to the order 1/h⁴
};

/// Source: image of the stresslet averaged over the volume, from Blake's tensor
DriftErrors drift_errors(const VesicleDiagnostics& d, const Matrix& position, double viscosity) {
  const int order = order_of(position.rows());
  const Matrix3 m = volume_moments(make_surface(SphereTransform(order, make_grid(2 * order)), position)).spread;
  Matrix3 s = -0.5 * (d.rheology.moment() + d.rheology.moment().transpose());
  s -= s.trace() / 3.0 * Matrix3::Identity();
  const double h = d.centroid_z;
  const double leading = 9.0 / 8.0 * s(2, 2) / (h * h);
  const double next = (9.0 / 8.0 * m(2, 2) * s(2, 2) - 75.0 / 64.0 * (m(0, 0) + m(1, 1)) * s(2, 2) +
                       15.0 / 32.0 * (m(0, 0) * s(0, 0) + m(1, 1) * s(1, 1)) + 15.0 / 16.0 * m(0, 1) * s(0, 1) +
                       21.0 / 8.0 * (m(0, 2) * s(0, 2) + m(1, 2) * s(1, 2))) /
                      std::pow(h, 4);
  const double speed = 8.0 * std::numbers::pi * viscosity * d.centroid_velocity_z;
  return {h / std::sqrt(d.area / (4.0 * std::numbers::pi)), speed / leading - 1.0, speed / (leading + next) - 1.0};
}

/// An effect that is added to a model.
struct AddedEffect {
  const char* name;
  void (*add)(Model&);
};

}  // namespace

// Spheres are rigid whatever the viscosity inside. Source: Brenner 1961
BOOST_AUTO_TEST_CASE(spheres_towards_a_wall_move_as_brenner_says) {
  struct Row {
    double height, drag;
    int order;
    double most;
  };
  for (const auto& [height, drag, order, most] :
       {Row{10.067662, 1.12524644, 16, 1e-7}, Row{5.0, 1.28508656, 16, 1e-7}, Row{3.0, 1.56920539, 16, 1e-7},
        Row{2.0, 2.12553557, 16, 1e-7}, Row{1.5430806, 3.03606451, 16, 1e-7}, Row{1.1, 11.45915720, 32, 1e-4}}) {
    for (const double ratio : {1.0, 5.0}) {
      const Model model = pulled(-Vector3::UnitZ(), 2.5, ratio, floor_without_slip());
      const double expected = -1.0 / (6.0 * std::numbers::pi * 2.5 * drag);
      const Vector3 found = velocity_of(model, height_above(sphere(order), height), true);
      BOOST_TEST((found - expected * Vector3::UnitZ()).norm() < most * std::abs(expected),
                 "height " << height << ", ratio " << ratio << ": " << found.z() / expected - 1.0);
    }
  }
  const Wall wall = oblique_wall(WallFlow::no_slip, WallField::none);
  const Matrix at = at_gap(wall, sphere(16), 1.0);
  const Vector3 found = velocity_of(pulled(wall.normal, 1.0, 1.0, wall), at, false);
  const double expected = 1.0 / (6.0 * std::numbers::pi * 2.12553557);
  BOOST_TEST((found - expected * wall.normal).norm() < 1e-7 * expected);
}

BOOST_AUTO_TEST_CASE(distant_spheres_move_along_a_wall_as_faxen_says) {
  for (const double height : {4.0, 8.0}) {
    const Model model = pulled(Vector3::UnitX(), 2.5, 3.0, floor_without_slip());
    const Vector3 found = velocity_of(model, height_above(sphere(14), height), true);
    const double s = 1.0 / height, alone = 1.0 / (6.0 * std::numbers::pi * 2.5);
    const double faxen =
        1.0 - 9.0 / 16.0 * s + 1.0 / 8.0 * std::pow(s, 3) - 45.0 / 256.0 * std::pow(s, 4) - 1.0 / 16.0 * std::pow(s, 5);
    BOOST_TEST((found / alone - faxen * Vector3::UnitX()).norm() < std::pow(s, 6),
               "height " << height << ": " << (found.x() / alone - faxen) / std::pow(s, 6));
  }
}

// Source: image of the stresslet averaged over the volume, from Blake's tensor
BOOST_AUTO_TEST_CASE(vesicles_far_from_a_wall_drift_as_their_stresslets_do) {
  Model model = shear_model();
  model.wall = floor_without_slip();
  const Matrix3 turn(Eigen::AngleAxisd(1.0, Vector3::UnitY()));
  const Matrix turned = rotated_fields(ellipsoid(10, {1.0, 1.0, 1.2}), turn) * turn.transpose();
  for (const double height : {10.0, 20.0, 40.0}) {
    const std::vector<Matrix> positions{height_above(turned, height)};
    Instruments instruments;
    const Evaluation found = evaluate(model, discretisation_of(positions), at_rest(positions), instruments);
    const DriftErrors errors = drift_errors(found.diagnostics.vesicles[0], positions[0], model.viscosity);
    BOOST_TEST(std::abs(errors.leading * height * height + 1.52) < 0.02, "height " << height << ": " << errors.leading);
    BOOST_TEST(std::abs(errors.both) * errors.radii * errors.radii < 0.2, "height " << height << ": " << errors.both);
  }
}

// At t = 4 the lift is that of steady tank-treading.
BOOST_AUTO_TEST_CASE(tank_treading_vesicles_are_lifted_as_their_stresslets_are) {
  Model model = shear_model();
  model.wall = floor_without_slip();
  const Matrix3 turn(Eigen::AngleAxisd(-25.0 / 180.0 * std::numbers::pi, Vector3::UnitY()));
  const Matrix leaning = ellipsoid(12, {1.6, 1.0, 1.0}) * turn.transpose();
  for (const double height : {3.6, 7.0, 14.0}) {
    const Matrix position = height_above(leaning, height);
    constexpr double end = 4.0;
    EvolutionSetup setup;
    setup.model = model;
    setup.settings.order = 12;
    setup.settings.time_order = 5;
    setup.settings.beside_wall = true;
    setup.symmetry = find_symmetry(model, at_rest(position));
    setup.control = {end, 1e-9 * end, 1e-4};
    Instruments instruments;
    Evolution evolution(setup, {StartMembrane{position}}, instruments);
    evolution.evaluate_start();
    while (evolution.state().time < end) evolution.step({{}, end});
    const DriftErrors errors = drift_errors(evolution.evaluation().diagnostics.vesicles[0],
                                            evolution.state().vesicles[0].position, model.viscosity);
    BOOST_TEST(std::abs(errors.both) < 0.05, errors.radii << " radii: " << errors.both);
    BOOST_TEST(std::abs(errors.both) * errors.radii * errors.radii < 0.5, errors.radii << " radii: " << errors.both);
  }
}

// All rates beside a mirroring wall equal those of two mirrored vesicles.
BOOST_AUTO_TEST_CASE(a_wall_that_mirrors_is_a_scene_of_mirrored_vesicles) {
  const std::vector<AddedEffect> effects{
      {"none", [](Model&) {}},
      {"displacement currents", [](Model& model) { model.electric->displacement_current = true; }},
      {"averaged field", [](Model& model) { model.electric->averaged_frequency = 0.5; }},
      {"porosity", [](Model& model) {
         model.vesicles[0].reaction = std::make_shared<MembranePorosity>(PorosityParameters{3.0, 0.6, 3.0, 0.2, 50.0});
       }}};
  for (const AddedEffect& effect : effects) {
    for (const WallField field : {WallField::insulating, WallField::electrode}) {
      const Wall wall = oblique_wall(WallFlow::stress_free, field);
      const MirrorImage mirror{wall};
      Model model = field_model();
      model.electric->field = field == WallField::electrode ? wall.normal : wall.normal.unitOrthogonal();
      model.wall = wall;
      model.vesicles[0].viscosity_ratio = 3.0;
      model.vesicles[0].inside.permittivity_ratio = 0.6;
      effect.add(model);
      Model two = with_vesicles(model, 2);
      two.wall.reset();
      const double sign = field == WallField::electrode ? -1.0 : 1.0;
      for (const Matrix& shape : {asymmetric_shape(10), shape_33(10)}) {
        const Matrix position = at_gap(wall, shape, 0.3);
        const std::vector<Matrix> one{position}, all{position, mirror.position(position)};
        State state = at_rest(one), both = at_rest(all);
        VesicleState& vesicle = state.vesicles[0];
        if (!is_averaged(model)) vesicle.transmembrane_potential = 0.3 * position * Vector3(0.2, -0.5, 0.6);
        if (relaxes_charge(model)) vesicle.free_charge = position * Vector3(0.1, 0.2, -0.1);
        if (model.vesicles[0].reaction) vesicle.poration = 0.1 * (harmonic(10, 0, 0) + 0.2 * position.col(0));
        both.vesicles[0] = both.vesicles[1] = vesicle;
        both.vesicles[1].position = all[1];
        for (const auto& [member, parity] : {std::pair{&VesicleState::transmembrane_potential, sign},
                                             {&VesicleState::free_charge, sign},
                                             {&VesicleState::poration, 1.0}}) {
          if ((vesicle.*member).size() > 0) both.vesicles[1].*member = parity * mirror.scalar(vesicle.*member);
        }
        const SolvedFields found = solved(model, discretisation_of(one, solved_to_rounding(10)), state);
        const SolvedFields expected = solved(two, discretisation_of(all, solved_to_rounding(10)), both);
        const auto agree = [&](const auto& of) {
          const Matrix value = of(found), reference = of(expected);
          BOOST_TEST_CONTEXT(effect.name) {
            BOOST_TEST(value.size() == reference.size());
            if (reference.size() > 0) BOOST_TEST(relative_difference(value, reference) < 1e-9);
          }
        };
        agree([](const SolvedFields& f) -> Matrix { return f.fields.vesicles[0].velocity; });
        agree([](const SolvedFields& f) -> Matrix { return f.fields.vesicles[0].force_electric; });
        agree([](const SolvedFields& f) -> Matrix { return f.fields.vesicles[0].potential_amplitude; });
        agree([](const SolvedFields& f) -> Matrix { return f.vesicles[0].rate.transmembrane_potential; });
        agree([](const SolvedFields& f) -> Matrix { return f.vesicles[0].rate.free_charge; });
        agree([](const SolvedFields& f) -> Matrix { return f.vesicles[0].rate.poration; });
      }
    }
  }
}

// Results are the same in other axes, and anywhere along the wall.
BOOST_AUTO_TEST_CASE(scenes_that_are_turned_and_moved_with_their_wall_are_the_same) {
  Model model = shear_model();
  model.wall = floor_without_slip();
  model.vesicles.front().viscosity_ratio = 2.0;
  const std::vector<Matrix> here{at_gap(*model.wall, asymmetric_shape(16), 0.2)};
  const Matrix velocity = solved(model, discretisation_of(here), at_rest(here)).fields.vesicles[0].velocity;
  const std::vector<Matrix> along{translated(here[0], {5.0, -3.0, 0.0})};
  BOOST_TEST(relative_difference(solved(model, discretisation_of(along), at_rest(along)).fields.vesicles[0].velocity,
                                 velocity) < 1e-8);
  // Another grid truncates differently: without a wall the velocities differ by 8.9e-6.
  Frame frame;
  frame.axes = Eigen::AngleAxisd(0.8, Vector3(1.0, 2.0, -0.5).normalized()).toRotationMatrix();
  const Model there = in_frame(frame, model);
  const State turned = in_frame(frame, at_rest(here));
  const Fields found = in_laboratory(
      frame, solved(there, discretisation_of(std::vector<Matrix>{turned.vesicles[0].position}), turned).fields);
  BOOST_TEST(relative_difference(found.vesicles[0].velocity, velocity) < 1.5e-5);
}

// The axis is the normal of the wall through the vesicle, at any position.
BOOST_AUTO_TEST_CASE(an_axis_is_found_off_the_origin) {
  Model model = relaxation_model(0.1);
  model.wall = Wall{{0.0, 0.5, 0.0}, Vector3::UnitX(), WallFlow::no_slip, WallField::none};
  const State state = at_rest(translated(ellipsoid(8, {1.3, 1.0, 1.0}), {2.0, 1.0, -3.0}));
  const Frame frame = find_frame(model, state);
  const Model there = in_frame(frame, model);
  const State moved = in_frame(frame, state);
  BOOST_TEST(find_symmetry(there, moved).axisymmetric);
  BOOST_TEST(std::abs(nearest_to_wall(*there.wall, moved.vesicles[0].position).distance - 0.7) < 1e-12);
}

// Vesicles above the same wall may be images of one another.
BOOST_AUTO_TEST_CASE(exchanged_vesicles_above_a_wall_are_those_that_are_all_computed) {
  Model model = field_model();
  model.electric->field = Vector3::UnitZ();
  model.wall = Wall{Vector3::Zero(), Vector3::UnitZ(), WallFlow::no_slip, WallField::electrode};
  model = with_vesicles(model, 2);
  const Matrix ellipsoid_here = ellipsoid(8, {0.8, 1.0, 1.2});
  const std::vector<Matrix> positions{translated(ellipsoid_here, {-1.1, 0.0, 1.5}),
                                      translated(ellipsoid_here, {1.1, 0.0, 1.5})};
  const Symmetry symmetry = find_symmetry(model, at_rest(positions));
  BOOST_TEST(symmetry.exchange.any());
  const auto found = [&](const Symmetry& used) {
    const Discretisation discretisation = discretisation_of(positions, {}, used);
    return solved(model, discretisation, start(model, discretisation, positions, 0.1, true));
  };
  const SolvedFields all = found({}), one = found(symmetry);
  for (const std::size_t a : {0, 1}) {
    BOOST_TEST(relative_difference(one.fields.vesicles[a].velocity, all.fields.vesicles[a].velocity) < 1e-7);
    BOOST_TEST(relative_difference(one.fields.vesicles[a].force_electric, all.fields.vesicles[a].force_electric) <
               1e-8);
  }
}

BOOST_AUTO_TEST_CASE(weight_is_carried_to_the_wall) {
  const Model model = pulled(-Vector3::UnitZ(), 1.0, 2.0, floor_without_slip());
  const std::vector<Matrix> positions{at_gap(*model.wall, prolate(10), 0.2)};
  Instruments instruments;
  const Evaluation found = evaluate(model, discretisation_of(positions), at_rest(positions), instruments);
  const VesicleDiagnostics& d = found.diagnostics.vesicles[0];
  // Bending and tension add up to zero up to the truncation error of degree 10.
  BOOST_TEST(std::abs(d.force_wall - d.volume / (4.0 / 3.0 * std::numbers::pi)) < 1e-6 * d.force_wall);
  BOOST_TEST(std::abs(d.gap_wall - 0.2) < 1e-12);
}

// Use of the symmetry about the normal changes nothing.
BOOST_AUTO_TEST_CASE(a_sinking_vesicle_keeps_its_symmetry) {
  Model model = pulled(Vector3(0.0, 0.0, -1.0), 1.0, 1.0, floor_without_slip());
  const Matrix position = at_gap(*model.wall, prolate(10), 0.5);
  BOOST_TEST(find_symmetry(model, at_rest(position)).axisymmetric);
  BOOST_TEST(difference_with_symmetry(model, position, 0.1, 3) < 1e-8);
}

BOOST_AUTO_TEST_CASE(a_vesicle_too_near_to_a_wall_is_named) {
  const Wall wall = floor_without_slip();
  const Discretisation discretisation({.order = 6});
  State state = at_rest(height_above(sphere(6), 1.5));
  state.vesicles[0].reference_area = 4.0 * std::numbers::pi;
  const SmallestGap gap = find_smallest_gap(state, discretisation, wall, 1e-3);
  BOOST_TEST(gap.to_wall);
  BOOST_TEST(std::abs(gap.distance - 0.5) < 1e-12);
  BOOST_TEST((gap.place - Vector3(0.0, 0.0, 0.25)).norm() < 1e-6);
  // The image is one radius away.
  BOOST_TEST(std::abs(gap.degree() - thresholds::degrees_of_gap(1e-3)) < 1e-12);
  state = at_rest(height_above(sphere(6), 1.0005));
  state.vesicles[0].reference_area = 4.0 * std::numbers::pi;
  BOOST_CHECK_EXCEPTION(
      require_gap(find_smallest_gap(state, discretisation, wall, 1e-3), gap, 0.1, Frame{}, {}), ConvergenceError,
      [](const ConvergenceError& error) {
        return std::string(error.what()) ==
               "the vesicle comes within 0.0005 radii of the wall at (0, 0, 0.00025); accepted: at least 0.001, "
               "the smallest gap for which the layers are tested";
      });
}

BOOST_AUTO_TEST_SUITE_END()
