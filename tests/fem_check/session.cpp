#include "fem_check/session.hpp"

#include <boost/test/unit_test.hpp>
#include <memory>

namespace {

/// MPI for the whole test program.
struct MpiFixture {
  MpiFixture() {
    auto& suite = boost::unit_test::framework::master_test_suite();
    session = std::make_unique<vehd::fem_check::Session>(suite.argc, suite.argv);
  }
  std::unique_ptr<vehd::fem_check::Session> session;
};

BOOST_TEST_GLOBAL_FIXTURE(MpiFixture);

}  // namespace
