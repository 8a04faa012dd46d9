// SPDX-License-Identifier: BSL-1.0
#include "force_laws.hpp"

TEST_CASE("every force field over Rigid3f obeys the laws of forces") {
  laws::check_force_fields<sinew::Extended, sinew::Rigid3f>();
}
