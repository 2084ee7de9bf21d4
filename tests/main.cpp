#define BOOST_TEST_MODULE vehd
#include <boost/test/unit_test.hpp>
