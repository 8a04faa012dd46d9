// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>

#include <Eigen/Core>

#include <cstdint>
#include <string>
#include <string_view>

namespace sinew {

/// A file of the compliance of a body: a line of text that says for which it is, then the n x n numbers,
/// doubles of this machine column by column.
struct ComplianceFile {
  std::string path{};
  double dt = 0;           // length of the steps of which it is
  std::uint64_t body = 0;  // of the body of which it is: a number that its rest positions have

  bool exists() const;
  /// Throws Error where the file cannot be read, is of another body or another step, ends early or too late,
  /// or has a number that is not finite, and where the matrix is not symmetric.
  void read(Eigen::MatrixXd& compliance, std::string_view where) const;
  /// Throws Error where the file cannot be written whole.
  void write(Eigen::MatrixXd const& compliance, std::string_view where) const;
};

}  // namespace sinew

#if SINEW_DEFINES
#include <sinew/core/error.hpp>

#include <filesystem>
#include <fstream>
#include <sstream>

namespace sinew {

namespace detail {
inline constexpr std::string_view complianceMagic = "sinew-compliance-1";
}

SINEW_ONCE bool ComplianceFile::exists() const { return std::filesystem::exists(path); }

SINEW_ONCE void ComplianceFile::read(Eigen::MatrixXd& compliance, std::string_view where) const {
  auto refuse = [&](std::string const& reason) {
    throw Error(where,
                text("the compliance in '", path, "' ", reason, "; remove the file, or set recompute"));
  };
  std::ifstream in(path, std::ios::binary);
  std::string line, magic;
  if (!in || !std::getline(in, line)) refuse("cannot be read");
  std::istringstream words(line);
  long long n = 0;
  double step = 0;
  std::uint64_t of = 0;
  if (!(words >> magic >> n >> step >> of) || magic != detail::complianceMagic)
    refuse(text(
        "does not begin with '", detail::complianceMagic, "', so that it is none that was written here"));
  if (n != compliance.rows() || of != body)
    refuse(text("is of another body: it has ",
                n,
                " degrees of freedom, this one ",
                compliance.rows(),
                n == compliance.rows() ? " at other rest positions" : ""));
  if (step != dt) refuse(text("is of steps of ", step, " s, and these are of ", dt, " s"));
  const auto bytes = std::streamsize(compliance.size()) * std::streamsize(sizeof(double));
  in.read(reinterpret_cast<char*>(compliance.data()), bytes);
  if (in.gcount() != bytes || in.peek() != std::ifstream::traits_type::eof())
    refuse(text("has not the ", compliance.size(), " numbers that it says"));
  if (!compliance.allFinite()) refuse("has a number that is not finite");
  if (!((compliance - compliance.transpose()).norm() <= 1e-6 * compliance.norm())) refuse("is not symmetric");
}

SINEW_ONCE void ComplianceFile::write(Eigen::MatrixXd const& compliance, std::string_view where) const {
  std::ofstream out(path, std::ios::binary);
  std::ostringstream head;
  head.precision(17);
  head << detail::complianceMagic << ' ' << compliance.rows() << ' ' << dt << ' ' << body << '\n';
  out << head.str();
  out.write(reinterpret_cast<char const*>(compliance.data()),
            std::streamsize(compliance.size()) * std::streamsize(sizeof(double)));
  out.flush();
  if (!out)
    throw Error(
        where,
        text("the compliance cannot be written to '", path, "'; name a file in a folder that is there"));
}

}  // namespace sinew
#endif
