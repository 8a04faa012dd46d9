// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/platform.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <new>
#include <vector>

namespace sinew {

/// A dense vector or matrix of Eigen that keeps its room where it becomes smaller, so that what has another
/// size in each step allocates only where it grows beyond all before. Copies have their own values.
template <class Plain>
class Reserved : public Eigen::Map<Plain> {
  using Map = Eigen::Map<Plain>;
  using Scalar = typename Plain::Scalar;
  static constexpr Eigen::Index noColumns = std::max<Eigen::Index>(0, Plain::ColsAtCompileTime);

 public:
  Reserved() : Map(nullptr, 0, noColumns) {}
  Reserved(Reserved const& o) : Reserved() { *this = o; }
  template <class E>
  Reserved(Eigen::MatrixBase<E> const& o) : Reserved() {
    *this = o;
  }
  Reserved& operator=(Reserved const& o) {
    if (this == &o) return *this;
    return *this = static_cast<Eigen::MatrixBase<Map> const&>(o);
  }
  template <class E>
  Reserved& operator=(Eigen::MatrixBase<E> const& o) {
    resize(o.rows(), o.cols());
    Map::operator=(o.derived());
    return *this;
  }
  template <class E>
  Reserved& operator=(Eigen::ReturnByValue<E> const& o) {
    return *this = Plain(o);
  }

  /// Values are those that its room had.
  void resize(Eigen::Index rows, Eigen::Index columns = 1) {
    const auto needed = std::size_t(rows) * std::size_t(columns);
    if (room_.size() < needed) room_.resize(needed);
    ::new (static_cast<Map*>(this)) Map(room_.data(), rows, columns);
  }
  void reserve(std::size_t values) {
    if (values > room_.size()) {
      const Plain kept = *this;
      room_.resize(values);
      *this = kept;
    }
  }
  using Map::setZero;
  void setZero(Eigen::Index rows, Eigen::Index columns = 1) {
    resize(rows, columns);
    Map::setZero();
  }

 private:
  std::vector<Scalar> room_{};
};

using ReservedVector = Reserved<Eigen::VectorXd>;

}  // namespace sinew
