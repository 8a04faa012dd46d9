// SPDX-License-Identifier: BSL-1.0
#include "liver.hpp"
#include "running.hpp"

page::Running page::run_liver() { return initialised("liver", liver(), dt); }
