// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "sinew/options.hpp"

#include <sinew/mpi/communicator.hpp>

#include <memory>

namespace cli {

// What several processes do together; all of them call it. The exit status; where an Error ends all of them,
// `status` is that.
int run_on_ranks(RunOptions const& options, std::shared_ptr<sinew::mpi::Communicator> const& ranks,
                 int& status);
int sweep_on_ranks(SweepOptions const& options, char** argv, sinew::mpi::Communicator& ranks, int& status);

}  // namespace cli
