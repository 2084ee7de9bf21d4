#include "tests/hard/faults/run_damages.hpp"

#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "bie/files/hdf5_handle.hpp"
#include "bie/files/hdf5_reader.hpp"
#include "tests/support/files.hpp"

namespace {

using vehd::Hdf5Handle;

class Damager {
 public:
  Damager(std::filesystem::path folder, std::mt19937& random) : folder_(std::move(folder)), random_(random) {}

  RunDamage apply() {
    const std::size_t kind = below(20);
    if (kind < 8) return {"run.h5", edit_hdf5(folder_ / "run.h5")};
    if (kind < 13) return edit_table(any_of({"history.csv", "history_error.csv", "vesicles.csv"}));
    if (kind < 14 && std::filesystem::exists(folder_ / "summary.json")) return edit_summary();
    const std::string file = any_of({"run.h5", "run.h5", "history.csv", "history_error.csv", "vesicles.csv",
                                     "summary.json", "checkpoint.h5", "scene.toml", "run.xdmf"});
    if (kind < 18) return {file, flip_bits(folder_ / file)};
    if (kind < 19 && file != "summary.json") {
      std::filesystem::remove(folder_ / file);
      return {file, "removed"};
    }
    return {file, cut(folder_ / file)};
  }

 private:
  std::size_t below(std::size_t end) { return std::uniform_int_distribution<std::size_t>(0, end - 1)(random_); }

  /// One of the given files that exist.
  std::string any_of(std::vector<std::string> files) {
    std::erase_if(files, [&](const std::string& file) { return !std::filesystem::exists(folder_ / file); });
    return files[below(files.size())];
  }

  std::string flip_bits(const std::filesystem::path& file) {
    std::string text = file_text(file);
    const std::size_t place = below(text.size()), count = 1 + below(3);
    for (std::size_t i = place; i < std::min(place + count, text.size()); ++i) {
      text[i] = static_cast<char>(text[i] ^ (1 << below(8)));
    }
    write_text(file, text);
    return fmt::format("{} bytes at {} altered", count, place);
  }

  std::string cut(const std::filesystem::path& file) {
    const std::size_t size = below(std::filesystem::file_size(file));
    std::filesystem::resize_file(file, size);
    return fmt::format("cut to {} bytes", size);
  }

  RunDamage edit_table(const std::string& file) {
    std::vector<std::string> lines;
    std::istringstream stream(file_text(folder_ / file));
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    const std::size_t line = below(lines.size());
    std::string what;
    switch (below(5)) {
      case 0:
        what = "removed";
        lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(line));
        break;
      case 1:
        what = "written twice";
        lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(line), lines[line]);
        break;
      case 2:
        what = "and all below removed";
        lines.resize(line);
        break;
      default: {
        const std::size_t letter = below(lines[line].size());
        const char other = "0123456789.-e,n"[below(15)];
        // Writing the same letter would be no damage.
        lines[line][letter] = lines[line][letter] == other ? '7' : other;
        what = fmt::format("edited at column {}", letter + 1);
      }
    }
    std::string text;
    for (const std::string& each : lines) text += each + "\n";
    write_text(folder_ / file, text);
    return {file, fmt::format("line {} {}", line + 1, what)};
  }

  RunDamage edit_summary() {
    nlohmann::json summary = json_of(folder_ / "summary.json");
    auto entry = summary.begin();
    std::advance(entry, static_cast<std::ptrdiff_t>(below(summary.size())));
    const std::string key = entry.key();
    if (below(2) == 0) {
      summary.erase(key);
    } else if (entry->is_number()) {
      summary[key] = entry->get<double>() + 1.0;
    } else if (entry->is_boolean()) {
      summary[key] = !entry->get<bool>();
    } else {
      summary[key] = "edited";
    }
    write_text(folder_ / "summary.json", summary.dump(2));
    return {"summary.json", "edited at " + key};
  }

  std::string edit_hdf5(const std::filesystem::path& path) {
    std::vector<std::string> objects;
    {
      const vehd::Hdf5Reader reader(path);
      for (const auto& [object, checksum] : reader.object_checksums("/")) objects.push_back(object);
      for (const std::string& name : reader.members("/snapshots")) objects.push_back("/snapshots/" + name + "/seal");
      objects.emplace_back("/seal");
      std::erase(objects, "/");
    }
    const std::string object = objects[below(objects.size())];
    const Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
    BOOST_TEST_REQUIRE(file.valid());
    switch (below(5)) {
      case 0:
        H5Lmove(file.id(), object.c_str(), file.id(), (object + "_").c_str(), H5P_DEFAULT, H5P_DEFAULT);
        return object + " renamed";
      case 1:
        H5Ldelete(file.id(), object.c_str(), H5P_DEFAULT);
        return object + " removed";
      case 2:
        return edit_attribute(file.id(), object);
      default:
        return edit_values(file.id(), object);
    }
  }

  std::string edit_values(hid_t file, const std::string& object) {
    const Hdf5Handle handle(H5Oopen(file, object.c_str(), H5P_DEFAULT), H5Oclose);
    if (H5Iget_type(handle.id()) != H5I_DATASET) return edit_attribute(file, object);
    const Hdf5Handle type(H5Dget_type(handle.id()), H5Tclose), space(H5Dget_space(handle.id()), H5Sclose);
    if (H5Tget_class(type.id()) == H5T_STRING) {
      std::string text(H5Tget_size(type.id()), '\0');
      H5Dread(handle.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data());
      const std::size_t place = below(text.size());
      text[place] = text[place] == '1' ? '2' : '1';
      H5Dwrite(handle.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data());
      return fmt::format("letter {} of {} altered", place, object);
    }
    std::vector<double> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space.id())));
    H5Dread(handle.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    const std::vector<double> before = values;
    const double factor = std::vector{2.0, -1.0, 1.0 + 1e-9, std::numeric_limits<double>::quiet_NaN()}[below(4)];
    if (below(2) == 0) {
      for (double& value : values) value *= factor;
    } else {
      values[below(values.size())] *= factor;
    }
    // A factor does not change zeros.
    if (values == before) values.front() += 1.0;
    H5Dwrite(handle.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    return fmt::format("{} times {}", object, factor);
  }

  /// Replaces any attribute of that name: HDF5 1.10 does not write attributes of a group a second time.
  std::string edit_attribute(hid_t file, const std::string& object) {
    const Hdf5Handle handle(H5Oopen(file, object.c_str(), H5P_DEFAULT), H5Oclose);
    std::vector<std::string> names;
    const auto collect = [](hid_t, const char* name, const H5A_info_t*, void* data) -> herr_t {
      static_cast<std::vector<std::string>*>(data)->emplace_back(name);
      return 0;
    };
    H5Aiterate2(handle.id(), H5_INDEX_NAME, H5_ITER_INC, nullptr, collect, &names);
    const std::string name = names.empty() ? "added" : names[below(names.size())];
    if (!names.empty()) H5Adelete(handle.id(), name.c_str());
    if (!names.empty() && below(3) == 0) return fmt::format("attribute {} of {} removed", name, object);
    const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose);
    const Hdf5Handle attribute(
        H5Acreate2(handle.id(), name.c_str(), H5T_IEEE_F64LE, space.id(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    const double value = 0.1234;
    H5Awrite(attribute.id(), H5T_NATIVE_DOUBLE, &value);
    return fmt::format("attribute {} of {} altered", name, object);
  }

  std::filesystem::path folder_;
  std::mt19937& random_;
};

}  // namespace

RunDamage damage_run(const std::filesystem::path& folder, std::mt19937& random) {
  return Damager(folder, random).apply();
}
