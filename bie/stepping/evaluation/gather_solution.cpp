#include "bie/stepping/evaluation/gather_solution.hpp"

#include "bie/stepping/state/exchange.hpp"

namespace vehd {

namespace {

/// Of one vesicle.
struct SolvedVesicle {
  VesicleFields fields;
  Unknowns rate;
};

template <MaybeConst<SolvedVesicle> Vesicle, typename Visit>
void visit_members(Vesicle& vesicle, Visit& visit) {
  visit(vesicle.fields, vesicle.rate);
}

}  // namespace

void gather_from_owners(const Shares& shares, const Exchange& exchange, SolvedFields& solved) {
  if (shares.ranks().is_alone() && !exchange.any()) return;
  std::vector<SolvedVesicle> all(solved.vesicles.size());
  for (std::size_t a = 0; a < all.size(); ++a) {
    all[a] = {std::move(solved.fields.vesicles[a]), std::move(solved.vesicles[a].rate)};
  }
  shares.gather(all, [&exchange](const SolvedVesicle& of_original, std::size_t a) -> SolvedVesicle {
    const ImageOfFields& image = exchange.image(a);
    return {image_of(image, of_original.fields), image_of(image, of_original.rate)};
  });
  for (std::size_t a = 0; a < all.size(); ++a) {
    solved.fields.vesicles[a] = std::move(all[a].fields);
    solved.vesicles[a].rate = std::move(all[a].rate);
  }
}

}  // namespace vehd
