#include <algorithm>
#include <array>
#include <functional>
#include <initializer_list>
#include <string_view>
#include <vector>

#include "bie/runs/history.hpp"

namespace vehd {
namespace {

template <auto member>
double of_vesicle(const HistoryRow& row) {
  return row.diagnostics.vesicles.front().*member;
}
template <auto member>
double of_step(const HistoryRow& row) {
  return static_cast<double>(row.step.*member);
}
template <auto member>
double of_row(const HistoryRow& row) {
  return static_cast<double>(row.*member);
}

using D = VesicleDiagnostics;

double wrinkle_growth(const HistoryRow& row) { return row.step.dt * row.diagnostics.vesicles.front().wrinkling_rate; }

const Rheology& rheology_of(const HistoryRow& row) { return row.diagnostics.vesicles.front().rheology; }

template <auto vector, int i>
double component(const HistoryRow& row) {
  return (rheology_of(row).*vector)[i];
}

/// Entry (i, j) of the symmetric part of a contribution to the stress.
template <auto share, int i, int j>
double stress(const HistoryRow& row) {
  const Matrix3 moment = std::invoke(share, rheology_of(row));
  return 0.5 * (moment(i, j) + moment(j, i));
}

/// @param names  of the entries xx, yy, zz, xy, xz, yz
template <auto share>
void add_stress(const std::array<std::string_view, 6>& names, std::vector<HistoryColumn>& columns) {
  constexpr std::array entries = {stress<share, 0, 0>, stress<share, 1, 1>, stress<share, 2, 2>,
                                  stress<share, 0, 1>, stress<share, 0, 2>, stress<share, 1, 2>};
  for (std::size_t i = 0; i < names.size(); ++i) columns.push_back({names[i], "energy", entries[i]});
}

/// Rheology of one vesicle, or of all together.
void add_rheology(std::vector<HistoryColumn>& columns) {
  add_stress<&Rheology::moment>({"stress_xx", "stress_yy", "stress_zz", "stress_xy", "stress_xz", "stress_yz"},
                                columns);
  columns.push_back({"effective_viscosity_intrinsic", "1",
                     [](const HistoryRow& row) { return rheology_of(row).intrinsic_viscosity(); }});
  columns.push_back({"dipole_x", "dipole", component<&Rheology::dipole, 0>});
  columns.push_back({"dipole_y", "dipole", component<&Rheology::dipole, 1>});
  columns.push_back({"dipole_z", "dipole", component<&Rheology::dipole, 2>});
  columns.push_back({"power", "power", [](const HistoryRow& row) { return rheology_of(row).power(); }});
  columns.push_back({"power_electric", "power", [](const HistoryRow& row) { return rheology_of(row).electric_power; }});
  add_stress<&Rheology::bending>({"stress_bending_xx", "stress_bending_yy", "stress_bending_zz", "stress_bending_xy",
                                  "stress_bending_xz", "stress_bending_yz"},
                                 columns);
  add_stress<&Rheology::tension>({"stress_tension_xx", "stress_tension_yy", "stress_tension_zz", "stress_tension_xy",
                                  "stress_tension_xz", "stress_tension_yz"},
                                 columns);
  add_stress<&Rheology::electric>({"stress_electric_xx", "stress_electric_yy", "stress_electric_zz",
                                   "stress_electric_xy", "stress_electric_xz", "stress_electric_yz"},
                                  columns);
  add_stress<&Rheology::viscosity>({"stress_viscosity_xx", "stress_viscosity_yy", "stress_viscosity_zz",
                                    "stress_viscosity_xy", "stress_viscosity_xz", "stress_viscosity_yz"},
                                   columns);
}

const std::vector<HistoryColumn>& columns_of_one() {
  static const std::vector<HistoryColumn> all = [] {
    std::vector<HistoryColumn> columns = {
        {"time", "time", of_row<&HistoryRow::time>},
        {"dt", "time", of_step<&StepAttempt::dt>, ColumnMeaning::method},
        {"area", "area", of_vesicle<&D::area>},
        {"volume", "volume", of_vesicle<&D::volume>},
        {"reduced_volume", "1", of_vesicle<&D::reduced_volume>},
        {"bending_energy_scaled", "1", of_vesicle<&D::bending_energy_scaled>},
        {"tension_integral", "energy", of_vesicle<&D::tension_integral>},
        {"Vm_north", "potential", of_vesicle<&D::Vm_north>},
        {"q_north", "potential/length", of_vesicle<&D::q_north>},
        {"Vm_max", "potential", of_vesicle<&D::Vm_max>},
        {"extent_x", "length", of_vesicle<&D::extent_x>},
        {"extent_y", "length", of_vesicle<&D::extent_y>},
        {"extent_z", "length", of_vesicle<&D::extent_z>},
        {"inclination_deg", "1", of_vesicle<&D::inclination_deg>},
        {"area_drift", "1", of_vesicle<&D::area_drift>, ColumnMeaning::error},
        {"volume_drift", "1", of_vesicle<&D::volume_drift>, ColumnMeaning::error},
        {"strain_max", "1", of_vesicle<&D::strain_max>, ColumnMeaning::error},
        {"spectrum_tail", "1", of_vesicle<&D::spectrum_tail>, ColumnMeaning::method},
        {"iterations_flow", "1", of_step<&StepAttempt::iterations_flow>, ColumnMeaning::method},
        {"iterations_electric", "1", of_step<&StepAttempt::iterations_electric>, ColumnMeaning::method},
        {"rejected", "1", of_step<&StepAttempt::rejected>, ColumnMeaning::method},
        {"order", "1", of_row<&HistoryRow::order>, ColumnMeaning::method},
        {"truncation", "1", of_row<&HistoryRow::truncation>, ColumnMeaning::method},
        {"error_estimate", "1", of_step<&StepAttempt::error_estimate>, ColumnMeaning::method},
        {"quadrature_error", "1", of_vesicle<&D::quadrature_error>, ColumnMeaning::method},
        {"separation", "1", of_vesicle<&D::separation>, ColumnMeaning::method},
        {"raw_area", "1", of_step<&StepAttempt::raw_area>, ColumnMeaning::method},
        {"wrinkle_degree", "1", of_vesicle<&D::wrinkle_degree>, ColumnMeaning::method},
        {"centroid_x", "length", of_vesicle<&D::centroid_x>},
        {"centroid_y", "length", of_vesicle<&D::centroid_y>},
        {"centroid_z", "length", of_vesicle<&D::centroid_z>},
        {"centroid_velocity_x", "velocity", of_vesicle<&D::centroid_velocity_x>},
        {"centroid_velocity_y", "velocity", of_vesicle<&D::centroid_velocity_y>},
        {"centroid_velocity_z", "velocity", of_vesicle<&D::centroid_velocity_z>},
        {"tension_max", "force/length", of_vesicle<&D::tension_max>},
        {"elastic_energy_scaled", "1", of_vesicle<&D::elastic_energy_scaled>},
        {"aspect_ratio", "1", of_vesicle<&D::aspect_ratio>},
        {"aspect_ratio_field", "1", of_vesicle<&D::aspect_ratio_field>},
        {"Vm_pole_plus", "potential", of_vesicle<&D::Vm_pole_plus>},
        {"Vm_pole_minus", "potential", of_vesicle<&D::Vm_pole_minus>},
        {"Vm_phase_deg", "1", of_vesicle<&D::Vm_phase_deg>},
    };
    add_rheology(columns);
    return columns;
  }();
  return all;
}

std::vector<HistoryColumn> columns_named(std::initializer_list<std::string_view> names) {
  std::vector<HistoryColumn> columns;
  for (const std::string_view name : names) {
    columns.push_back(*std::ranges::find(columns_of_one(), name, &HistoryColumn::name));
  }
  return columns;
}

constexpr HistoryColumn gap_degree{"gap_degree", "1", [](const HistoryRow& row) { return row.gap.degree(); },
                                   ColumnMeaning::method};

const std::vector<HistoryColumn>& columns_of_all() {
  static const std::vector<HistoryColumn> all = [] {
    auto columns = columns_named({"time",
                                  "dt",
                                  "bending_energy_scaled",
                                  "tension_integral",
                                  "Vm_max",
                                  "area_drift",
                                  "volume_drift",
                                  "strain_max",
                                  "spectrum_tail",
                                  "iterations_flow",
                                  "iterations_electric",
                                  "rejected",
                                  "order",
                                  "truncation",
                                  "error_estimate",
                                  "quadrature_error",
                                  "separation",
                                  "raw_area",
                                  "wrinkle_degree",
                                  "tension_max",
                                  "elastic_energy_scaled"});
    columns.push_back({"smallest_gap", "length", [](const HistoryRow& row) { return row.gap.distance; }});
    columns.push_back({"gap_vesicle_a", "1", [](const HistoryRow& row) { return static_cast<double>(row.gap.first); },
                       ColumnMeaning::method});
    columns.push_back(
        {"gap_vesicle_b", "1",
         [](const HistoryRow& row) { return row.gap.to_wall ? -1.0 : static_cast<double>(row.gap.second); },
         ColumnMeaning::method});
    columns.push_back(gap_degree);
    add_rheology(columns);
    return columns;
  }();
  return all;
}

/// Columns of vesicles.csv: those of one vesicle, without those of the step.
const std::vector<HistoryColumn>& columns_of_each() {
  static const std::vector<HistoryColumn> all = [] {
    std::vector<HistoryColumn> columns = {columns_of_one().front(), {"vesicle", "1", of_row<&HistoryRow::vesicle>}};
    for (const HistoryColumn& column : columns_of_one()) {
      constexpr std::array of_the_step = {"time",     "dt",         "iterations_flow", "iterations_electric",
                                          "rejected", "truncation", "error_estimate",  "raw_area"};
      if (std::ranges::find(of_the_step, column.name) == of_the_step.end()) columns.push_back(column);
    }
    return columns;
  }();
  return all;
}

/// Columns of a membrane with spatially varying parameters only; they follow those of poration.
std::vector<HistoryColumn> varying_columns() {
  return {{"elastic_energy", "energy", of_vesicle<&D::elastic_energy>},
          {"net_force_x", "force", of_vesicle<&D::net_force_x>},
          {"net_force_y", "force", of_vesicle<&D::net_force_y>},
          {"net_force_z", "force", of_vesicle<&D::net_force_z>}};
}

/// Columns beside a wall.
std::vector<HistoryColumn> wall_columns(HistoryKind::Rows rows) {
  std::vector<HistoryColumn> columns{{"gap_wall", "length", of_vesicle<&D::gap_wall>},
                                     {"force_wall", "force", of_vesicle<&D::force_wall>}};
  if (rows == HistoryKind::of_one) columns.push_back(gap_degree);
  return columns;
}

template <std::size_t l>
double shape_mode(const HistoryRow& row) {
  return row.diagnostics.vesicles.front().shape_modes[l - 2];
}

/// Modes of the shape about the direction of the field.
std::vector<HistoryColumn> mode_columns() {
  return {{"shape_mode_2", "1", shape_mode<2>},
          {"shape_mode_3", "1", shape_mode<3>},
          {"shape_mode_4", "1", shape_mode<4>},
          {"shape_mode_5", "1", shape_mode<5>},
          {"shape_mode_6", "1", shape_mode<6>}};
}

/// Columns that vanish without a linear flow with vorticity.
std::vector<HistoryColumn> turning_columns() {
  return {{"tumbling_angle_deg", "1", of_vesicle<&D::tumbling_angle_deg>},
          {"tumbling_frequency", "1/time", of_vesicle<&D::tumbling_frequency>},
          {"treading_frequency", "1/time", of_vesicle<&D::treading_frequency>}};
}

/// Normal-stress differences of a flow along x with its gradient along z.
std::vector<HistoryColumn> normal_stress_columns() {
  return {{"normal_stress_1", "energy",
           [](const HistoryRow& row) { return rheology_of(row).moment()(0, 0) - rheology_of(row).moment()(2, 2); }},
          {"normal_stress_2", "energy",
           [](const HistoryRow& row) { return rheology_of(row).moment()(2, 2) - rheology_of(row).moment()(1, 1); }}};
}

}  // namespace

std::vector<HistoryColumn> poration_columns(PorationModel model) {
  switch (model) {
    case PorationModel::porosity:
      return {{"conductance_max", "conductance/area", of_vesicle<&D::conductance_max>},
              {"porosity_max", "1", of_vesicle<&D::poration_max>},
              {"porosity_mean", "1", of_vesicle<&D::poration_mean>}};
    case PorationModel::pores:
      return {{"conductance_max", "conductance/area", of_vesicle<&D::conductance_max>},
              {"pore_density_max", "1/area", of_vesicle<&D::poration_max>},
              {"pore_density_mean", "1/area", of_vesicle<&D::poration_mean>}};
    case PorationModel::criterion:
      break;
  }
  return {{"poration_load", "1", of_vesicle<&D::poration_load>},
          {"poration_time", "time", of_vesicle<&D::poration_time>},
          {"poration_x", "length", of_vesicle<&D::poration_x>},
          {"poration_y", "length", of_vesicle<&D::poration_y>},
          {"poration_z", "length", of_vesicle<&D::poration_z>}};
}

const std::vector<HistoryColumn>& history_columns(HistoryKind kind) {
  static const std::array usual = {&columns_of_one(), &columns_of_all(), &columns_of_each()};
  // Without poration and with each of its models; each with and without varying parameters and a wall.
  using OfRows = std::array<std::vector<HistoryColumn>, usual.size()>;
  static const auto of_kinds = [] {
    std::array<std::array<OfRows, 4>, n_poration_models + 1> all;
    for (std::size_t model = 0; model < all.size(); ++model) {
      for (std::size_t others = 0; others < 4; ++others) {
        const bool varying = others % 2 > 0, wall = others / 2 > 0;
        for (std::size_t rows = 0; rows < usual.size(); ++rows) {
          std::vector<HistoryColumn>& columns = all.at(model).at(others).at(rows) = *usual.at(rows);
          const auto append = [&](const std::vector<HistoryColumn>& more) {
            columns.insert(columns.end(), more.begin(), more.end());
          };
          const bool reacts = model > 1, of_whole = rows == HistoryKind::of_all;
          // With several vesicles, vesicles.csv has the columns of porosity and pores.
          if (model > 0 && !(reacts && of_whole)) append(poration_columns(static_cast<PorationModel>(model - 1)));
          if (varying && !of_whole) append(varying_columns());
          if (wall) append(wall_columns(static_cast<HistoryKind::Rows>(rows)));
          if (rows != HistoryKind::of_each) append({{"wrinkle_growth", "1", wrinkle_growth, ColumnMeaning::method}});
          if (!of_whole) append({{"shape_rate", "1/time", of_vesicle<&D::shape_rate>}});
          if (!of_whole) append(mode_columns());
          append(normal_stress_columns());
          if (!of_whole) append(turning_columns());
        }
      }
    }
    return all;
  }();
  const std::size_t model = kind.poration ? static_cast<std::size_t>(*kind.poration) + 1 : 0;
  return of_kinds.at(model).at((kind.varying ? 1 : 0) + (kind.wall ? 2 : 0)).at(kind.rows);
}

HistoryKind history_kind(const Scene& scene) {
  HistoryKind kind(scene.vesicles.size() > 1 ? HistoryKind::of_all : HistoryKind::of_one);
  if (scene.poration) kind.poration = scene.poration->model;
  kind.varying = varies_or_pumps(scene);
  kind.wall = scene.wall.has_value();
  return kind;
}

HistoryKind of_each_like(HistoryKind kind) {
  kind.rows = HistoryKind::of_each;
  return kind;
}

}  // namespace vehd
