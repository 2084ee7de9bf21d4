#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace vehd {

/// What a timing holds for.
struct MachineRecord {
  std::string processor;  ///< as the operating system names it
  unsigned hardware_threads = 0;
  int threads = 0;  ///< that this process uses
  std::string compiler, version, commit;
};
MachineRecord machine_record();
nlohmann::ordered_json json_of(const MachineRecord& machine);
/// One line for people.
std::string text_of(const MachineRecord& machine);

/// Repeats of one timing.
struct Spread {
  double median = 0.0, min = 0.0, max = 0.0;
  std::int64_t repeats = 0;
};
/// @param values  at least one
Spread spread_of(std::vector<double> values);

/// Whether a timing is to be repeated once more: not beyond the wanted number, and not where it has taken seconds
/// already, because it is long enough then.
bool wants_repeat(const std::vector<double>& seconds, int repeats);

/// Exponent b of y = a x^b, by least squares of the logarithms. @param x, y  positive, at least two different x
double fitted_exponent(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace vehd
