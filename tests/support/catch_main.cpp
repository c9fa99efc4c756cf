// The test runner's main() for Catch2 2.
#define CATCH_CONFIG_MAIN
#include <catch2/catch.hpp>
