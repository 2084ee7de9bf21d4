#include "bie/stepping/evaluation/gather_solution.hpp"

#include "bie/stepping/state/exchange.hpp"

namespace vehd {

namespace {

/// Of one vesicle.
struct SolvedVesicle {
  VesicleFields fields;
  Vector potential_rate, poration_rate, free_charge_rate;
};

template <MaybeConst<SolvedVesicle> Vesicle, typename Visit>
void visit_members(Vesicle& vesicle, Visit& visit) {
  visit(vesicle.fields);
  visit(vesicle.potential_rate, vesicle.poration_rate, vesicle.free_charge_rate);
}

}  // namespace

void gather_from_owners(const Shares& shares, const Exchange& exchange, SolvedFields& solved) {
  if (shares.ranks().is_alone() && !exchange.any()) return;
  std::vector<SolvedVesicle> all(solved.vesicles.size());
  for (std::size_t a = 0; a < all.size(); ++a) {
    VesicleSolution& solution = solved.vesicles[a];
    all[a] = {std::move(solved.fields.vesicles[a]), std::move(solution.potential_rate),
              std::move(solution.poration_rate), std::move(solution.free_charge_rate)};
  }
  shares.gather(all, [&exchange](const SolvedVesicle& of_original, std::size_t a) -> SolvedVesicle {
    const ImageOfFields& image = exchange.image(a);
    return {image_of(image, of_original.fields), image.potential(of_original.potential_rate),
            image.scalar(of_original.poration_rate), image.potential(of_original.free_charge_rate)};
  });
  for (std::size_t a = 0; a < all.size(); ++a) {
    VesicleSolution& solution = solved.vesicles[a];
    solved.fields.vesicles[a] = std::move(all[a].fields);
    solution.potential_rate = std::move(all[a].potential_rate);
    solution.poration_rate = std::move(all[a].poration_rate);
    solution.free_charge_rate = std::move(all[a].free_charge_rate);
  }
}

}  // namespace vehd
