#include "fem_check/session.hpp"

#include <boost/test/unit_test.hpp>

namespace {

/// MPI for the whole test program.
struct MpiFixture {
  vehd::fem_check::Session session;
};

BOOST_TEST_GLOBAL_FIXTURE(MpiFixture);

}  // namespace
