#pragma once

#include <boost/test/unit_test.hpp>
#include <filesystem>

inline std::filesystem::path finite_element_program() {
  return std::filesystem::path(VEHD_PROGRAM).parent_path() / "vehd_fem";
}

/// Precondition of tests of finite elements: *boost::unit_test::precondition(finite_elements_are_built).
inline boost::test_tools::assertion_result finite_elements_are_built(boost::unit_test::test_unit_id = 0) {
  return std::filesystem::exists(finite_element_program());
}
