#include "bie/runs/vesicle_rows.hpp"

#include <algorithm>
#include <cmath>

namespace vehd {
namespace {

/// Keeps the value of larger magnitude, or NaN.
void take_larger(double& value, double other) {
  if (std::isnan(value)) return;
  if (!(std::abs(other) <= std::abs(value))) value = other;
}

void add(VesicleDiagnostics& all, const VesicleDiagnostics& one) {
  for (const auto sum :
       {&VesicleDiagnostics::bending_energy_scaled, &VesicleDiagnostics::elastic_energy_scaled,
        &VesicleDiagnostics::tension_integral, &VesicleDiagnostics::elastic_energy, &VesicleDiagnostics::net_force_x,
        &VesicleDiagnostics::net_force_y, &VesicleDiagnostics::net_force_z, &VesicleDiagnostics::force_wall}) {
    all.*sum += one.*sum;
  }
  for (const auto worst :
       {&VesicleDiagnostics::Vm_max, &VesicleDiagnostics::area_drift, &VesicleDiagnostics::volume_drift,
        &VesicleDiagnostics::strain_max, &VesicleDiagnostics::spectrum_tail, &VesicleDiagnostics::wrinkle_degree,
        &VesicleDiagnostics::wrinkling_rate, &VesicleDiagnostics::quadrature_error}) {
    take_larger(all.*worst, one.*worst);
  }
  all.tension_max = std::max(all.tension_max, one.tension_max);
  all.conductance_max = std::max(all.conductance_max, one.conductance_max);
  all.poration_max = std::max(all.poration_max, one.poration_max);
  all.poration_load = std::max(all.poration_load, one.poration_load);
  if (one.poration_time < all.poration_time) {
    for (const auto of_crossing : {&VesicleDiagnostics::poration_time, &VesicleDiagnostics::poration_x,
                                   &VesicleDiagnostics::poration_y, &VesicleDiagnostics::poration_z}) {
      all.*of_crossing = one.*of_crossing;
    }
  }
  all.gap_wall = std::min(all.gap_wall, one.gap_wall);
  all.separation = std::min(all.separation, one.separation);
}

}  // namespace

HistoryRow row_of_all(HistoryRow row) {
  VesicleDiagnostics all = row.diagnostics.vesicles.front();
  for (std::size_t a = 1; a < row.diagnostics.vesicles.size(); ++a) add(all, row.diagnostics.vesicles[a]);
  std::vector<Rheology> rheology;
  for (const VesicleDiagnostics& one : row.diagnostics.vesicles) rheology.push_back(one.rheology);
  all.rheology = together(rheology);
  row.diagnostics.vesicles = {all};
  return row;
}

std::vector<HistoryRow> rows_of_each(const HistoryRow& row) {
  std::vector<HistoryRow> rows;
  for (std::size_t a = 0; a < row.diagnostics.vesicles.size(); ++a) {
    HistoryRow& own = rows.emplace_back();
    own.time = row.time;
    own.diagnostics.vesicles = {row.diagnostics.vesicles[a]};
    own.vesicle = static_cast<int>(a);
    own.order = row.orders.at(a);
  }
  return rows;
}

}  // namespace vehd
