// SPDX-License-Identifier: BSL-1.0
// A step through a virtual function, which the search for indirect calls must find.
struct Force {
  virtual ~Force() = default;
  virtual double at(double x) const = 0;
};

double step(Force const& force, double x, double v);
double step(Force const& force, double x, double v) {
  for (int i = 0; i < 4; ++i) {
    v += 0.01 * force.at(x);
    x += 0.01 * v;
  }
  return x;
}
