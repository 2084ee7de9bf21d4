#pragma once

#include <vector>

#include "bie/runs/history.hpp"

/// Rows of the tables of a run of several vesicles at one time.
namespace vehd {

/// The row of all vesicles: energies, ∫λ dA, forces and rheology are sums; every other column has the worst value of
/// any vesicle.
HistoryRow row_of_all(HistoryRow row);

/// One row of each vesicle.
std::vector<HistoryRow> rows_of_each(const HistoryRow& row);

}  // namespace vehd
