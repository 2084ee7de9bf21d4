#include "bie/stepping/evaluation/initial_state.hpp"

#include "bie/physics/membrane_charging.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/stepping/space/membrane_at.hpp"
#include "bie/stepping/state/symmetry.hpp"

namespace vehd {

namespace {

/// Before what is solved for.
SurfaceFields given_fields(const Model& model, const VesicleModel& vesicle, const StartMembrane& start) {
  const Index n = start.position.rows();
  SurfaceFields fields{start.position, Vector::Zero(n), {}, {}};
  if (vesicle.inextensible) fields.tension = Vector::Zero(n);
  if (!model.electric) return fields;
  const Vector& given = start.potential.given;
  fields.transmembrane_potential = given.size() > 0 ? resize_order(given, order_of(n)) : Vector::Zero(n);
  return fields;
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
    if (model.electric && membranes[a].potential.steady) {
      const Membrane membrane = membrane_at(space, position, {true, true, true, false}, 1.0, instruments);
      require_converged(steady_potential(electric_parameters(model, vesicle), vesicle.charging, membrane,
                                         discretisation.settings().electric_tolerance, start.transmembrane_potential),
                        "steady membrane potential");
    }
  }
  return state;
}

}  // namespace vehd
