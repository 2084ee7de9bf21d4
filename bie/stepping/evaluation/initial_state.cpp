#include "bie/stepping/evaluation/initial_state.hpp"

#include <algorithm>
#include <optional>

#include "bie/physics/electric.hpp"
#include "bie/physics/membrane_charging.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/stepping/space/discretisation.hpp"
#include "bie/stepping/state/symmetry.hpp"
#include "bie/support/errors.hpp"

namespace vehd {

namespace {

/// The given fields, before any solve.
SurfaceFields given_fields(const Model& model, const VesicleModel& vesicle, const StartMembrane& start) {
  const Index n = start.position.rows();
  SurfaceFields fields;
  fields.position = start.position;
  fields.area_strain = Vector::Zero(n);
  if (vesicle.inextensible) fields.tension = Vector::Zero(n);
  fields.material = start.material;
  for_each_property(fields.material,
                    [&](Vector& property) { property = resize_order(Matrix(property), order_of(n)).col(0); });
  if (!model.electric || is_averaged(model)) return fields;
  const Vector& given = start.potential.given;
  fields.transmembrane_potential = given.size() > 0 ? resize_order(given, order_of(n)) : Vector::Zero(n);
  if (relaxes_charge(model)) fields.free_charge = Vector::Zero(n);
  if (vesicle.reaction) {
    fields.poration = Vector::Zero(n);
    fields.poration[0] = vesicle.reaction->start() * coefficient_of_one;
  }
  return fields;
}

/// Sets V_m of all vesicles to its steady state; with displacement currents, also the charges of both faces.
void find_steady_potentials(const Model& model, const Discretisation& discretisation, State& state,
                            Instruments& instruments) {
  const bool interacts = state.vesicles.size() > 1 || model.wall;
  const Partition& partition = discretisation.partition();
  std::vector<Membrane> frozen;
  frozen.reserve(state.vesicles.size());
  std::vector<InteractingMembrane> interacting;
  std::vector<ChargingMembrane> membranes;
  std::vector<Vector> potentials;
  for (std::size_t a = 0; a < state.vesicles.size(); ++a) {
    const VesicleModel& vesicle = model.vesicles[a];
    const MembraneSpace& space = discretisation.vesicle(a);
    const Matrix& position = state.vesicles[a].position;
    const LayerSelection layers = partition.is_local(a) ? LayerSelection{true, true, true, false} : LayerSelection{};
    frozen.push_back(membrane_at(space, position, layers, 1.0, instruments));
    frozen.back().material = material_at(space, state.vesicles[a].material);
    membranes.push_back({{electric_parameters(model, vesicle), frozen.back()}, vesicle.charging});
    interacting.push_back({position, space.targets(), electric_pair_selection(membranes.back().in_field.electric),
                           space.subspace().symmetry()});
    potentials.push_back(state.vesicles[a].transmembrane_potential);
  }
  const Interaction interaction = interacts ? Interaction(interacting, {}, instruments, partition,
                                                          discretisation.symmetry().exchange, {}, model.wall)
                                            : Interaction();
  require_converged(steady_potentials(membranes, interaction, discretisation.settings().electric_tolerance, potentials),
                    "steady membrane potential");
  for (std::size_t a = 0; a < frozen.size(); ++a) {
    VesicleState& vesicle = state.vesicles[a];
    Unknowns charges = steady_charges(membranes[a], potentials[a]);
    vesicle.transmembrane_potential = std::move(charges.transmembrane_potential);
    vesicle.free_charge = std::move(charges.free_charge);
  }
}

}  // namespace

State initial_state(const Model& model, const Discretisation& discretisation,
                    const std::vector<StartMembrane>& membranes, double dt, Instruments& instruments) {
  State state;
  state.dt_next = dt;
  for (std::size_t a = 0; a < membranes.size(); ++a) {
    const VesicleModel& vesicle = model.vesicles[a];
    const MembraneSpace& space = discretisation.vesicle(a);
    const Matrix& position = membranes[a].position;
    VesicleState& start = state.vesicles.emplace_back();
    static_cast<SurfaceFields&>(start) = symmetric_part(space.subspace(), given_fields(model, vesicle, membranes[a]));
    const Surface surface = make_surface(space.fine_transform(), position);
    start.reference_area = surface_area(surface);
    start.reference_volume = enclosed_volume(surface);
    if (vesicle.criterion) start.crossing.emplace();
  }
  const auto is_steady = [](const StartMembrane& membrane) { return membrane.potential.steady; };
  if (model.electric && std::any_of(membranes.begin(), membranes.end(), is_steady)) {
    if (!std::all_of(membranes.begin(), membranes.end(), is_steady)) {
      throw InputError("some vesicles start with a steady V_m, others do not; accepted: all of them or none");
    }
    discretisation.partition().ranks().collective(
        [&] { find_steady_potentials(model, discretisation, state, instruments); });
  }
  return with_images(discretisation.symmetry().exchange, std::move(state));
}

}  // namespace vehd
