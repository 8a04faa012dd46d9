// SPDX-License-Identifier: BSL-1.0
// Engines over lists of numbers, values and places.
#include <sinew/engine/average_coord.hpp>
#include <sinew/engine/difference_engine.hpp>
#include <sinew/engine/hausdorff_distance.hpp>
#include <sinew/engine/index_value_mapper.hpp>
#include <sinew/engine/indices2values_mapper.hpp>
#include <sinew/engine/indices_from_values.hpp>
#include <sinew/engine/map_indices.hpp>
#include <sinew/engine/math_op.hpp>
#include <sinew/engine/merge_sets.hpp>
#include <sinew/engine/merge_vectors.hpp>
#include <sinew/engine/norm_engine.hpp>
#include <sinew/engine/roi_value_mapper.hpp>
#include <sinew/engine/sum_engine.hpp>
#include <sinew/engine/values_from_indices.hpp>
#include <sinew/engine/values_from_positions.hpp>

#include "catch.hpp"
#include "error_of.hpp"

namespace test_lists_of_values {

using namespace sinew;
using Catch::Matchers::Contains;
using Values = std::vector<double>;
using Numbers = std::vector<int>;

TEST_CASE("values are chosen, subtracted, summed and measured, of any size") {
  ValuesFromIndices v{.in = {0, 0, 0, 1, 2, 2, 3, 4, 12}, .indices = {2, 0, 2}, .size = 3};
  v.update("scene");
  CHECK(v.out == Values{3, 4, 12, 0, 0, 0, 3, 4, 12});
  v.indices = {3};
  CHECK_THAT(error_of([&] { v.update("scene"); }), Contains("indices has 3, but in has 3 values"));
  v.size = 4;
  CHECK_THAT(error_of([&] { v.update("scene"); }), Contains("9 numbers, which are no values of 4"));
  NormEngine n{.input = {3, -4, 0, 1, 2, -2}};
  for (auto const& [type, expected] :
       {std::pair<int, Values>{2, {5, 3}}, {1, {7, 5}}, {-1, {4, 2}}, {0, {2, 3}}}) {
    n.normType = type;
    n.update("scene");
    CHECK(n.output == expected);
  }
  DifferenceEngine d{.input = {5, 6, 7, 8}, .substractor = {1, 2, 3, 4}, .size = 2};
  d.update("scene");
  CHECK(d.output == Values{4, 4, 4, 4});
  d.substractor = {1, 2};
  CHECK_THAT(error_of([&] { d.update("scene"); }), Contains("input has 2 values and substractor 1"));
  SumEngine s{.input = {1, 2, 3, 10, 20, 30}, .size = 3};
  s.update("scene");
  CHECK(s.output == Values{11, 22, 33});
}

TEST_CASE("lists are merged, and found in each other") {
  MergeVectors m{.nbInputs = 3, .inputs = {{1, 2}, {}, {3}}};
  m.update("scene");
  CHECK(m.output == Values{1, 2, 3});
  m.nbInputs = 2;
  CHECK_THAT(error_of([&] { m.update("scene"); }), Contains("3 inputs, but nbInputs is 2"));
  MergeSets s{.in1 = {5, 1, 3, 1}, .in2 = {3, 4}};
  const std::pair<SetOperation, Numbers> expected[] = {{SetOperation::unite, {1, 3, 4, 5}},
                                                       {SetOperation::intersection, {3}},
                                                       {SetOperation::difference, {1, 5}},
                                                       {SetOperation::symmetricDifference, {1, 4, 5}}};
  for (auto const& [op, result] : expected) {
    s.op = op;
    s.update("scene");
    CHECK(s.out == result);
  }
  IndicesFromValues f{.values = {7, 8, 1, 2}, .global = {1, 2, 7, 8, 1, 2}, .size = 2};
  f.update("scene");
  CHECK(f.indices == Numbers{1, 0});
  f.recursiveSearch = true;
  f.update("scene");
  CHECK(f.indices == Numbers{1, 0, 2});
  CHECK(f.otherIndices == Numbers{0, 2, 1});
  f.recursiveSearch = false, f.values = {8, 7};
  CHECK_THAT(error_of([&] { f.update("scene"); }), Contains("value 0 is not in global"));
}

TEST_CASE("indices get values, and new numbers") {
  IndexValueMapper m{.inputValues = {3, 3}, .indices = {1, 4}, .value = 9, .defaultValue = 0.5};
  m.update("scene");
  CHECK(m.outputValues == Values{3, 9, 0.5, 0.5, 9});
  Indices2ValuesMapper l{.inputValues = {2, 1, 5}, .indices = {1, 2}, .values = {10, 20}, .defaultValue = -1};
  l.update("scene");
  CHECK(l.outputValues == Values{20, 10, -1});
  l.values.pop_back();
  CHECK_THAT(error_of([&] { l.update("scene"); }), Contains("2 indices and 1 values"));
  ROIValueMapper r{.nbROIs = 2, .indices = {{0, 1}, {1, 3}}, .values = {{5}, {6}}, .defaultValue = 7};
  r.update("scene");
  CHECK(r.outputValues == Values{5, 6, 7, 6});
  r.values.pop_back();
  CHECK_THAT(error_of([&] { r.update("scene"); }), Contains("region 2 has not one value; give value2"));
  MapIndices n{.in = {10, 30, 11}, .indices = {30, 20, 10}};
  n.update("scene");
  CHECK(n.out == Numbers{2, 0, 11});
  n.in = {2, 0, 11}, n.transpose = true;
  n.update("scene");
  CHECK(n.out == Numbers{10, 30, 11});
}

TEST_CASE("lists are combined number by number") {
  MathOp m{.inputs = {{1, 2, 3}, {4, 5}}};
  const std::pair<std::string, Values> expected[] = {{"+", {5, 7}},
                                                     {"-", {-3, -3}},
                                                     {"*", {4, 10}},
                                                     {"/", {0.25, 0.4}},
                                                     {"<", {1, 2}},
                                                     {">", {4, 5}},
                                                     {"&", {1, 1}},
                                                     {"!&", {0, 0}},
                                                     {"^", {0, 0}},
                                                     {"!^", {1, 1}}};
  for (auto const& [op, result] : expected) {
    m.op = op;
    m.update("scene");
    CHECK(m.output == result);
  }
  m.nbInputs = 1, m.inputs = {{2, 0}}, m.op = "!";
  m.update("scene");
  CHECK(m.output == Values{0, 1});
  m.op = "-";
  m.update("scene");
  CHECK(m.output == Values{-2, 0});
  m.op = "%";
  CHECK_THAT(error_of([&] { m.update("scene"); }), Contains("op is '%'"));
  m.nbInputs = 2;
  CHECK_THAT(error_of([&] { m.update("scene"); }), Contains("1 inputs, but nbInputs is 2"));
}

TEST_CASE("values along a direction are lines between those given") {
  ValuesFromPositions<Vec3d> v{.inputValues = {10, 20, 60},
                               .direction = {0, 2, 0},
                               .position = {{5, 0, 0}, {0, 1, 0}, {0, 3, 0}, {0, 4, 1}},
                               .edges = {{0, 3}, {0, 1}}};
  v.update("scene");
  CHECK(v.values == Values{10, 15, 40, 60});
  CHECK(v.edgeValues == Values{20, 12.5});
  v.fieldType = FieldKind::vector;
  v.update("scene");
  CHECK(v.values.empty());
  CHECK(v.edgeVectors == std::vector<Eigen::Vector3d>{{0, 2, 0}, {0, 2, 0}});
  v.edges = {{0, 4}};
  CHECK_THAT(error_of([&] { v.update("scene"); }), Contains("edge 0 refers to point 4"));
}

TEST_CASE("the distance of Hausdorff is that of the loneliest point") {
  HausdorffDistance h{.points1 = {0, 0, 0, 1, 0, 0}, .points2 = {0, 0, 0, 1, 3, 4, 0.5, 0, 0}};
  h.update("scene");
  CHECK(h.d12 == Approx(0.5));
  CHECK(h.d21 == Approx(5));
  CHECK(h.maximum == h.d21);
  h.size = 1, h.points1 = {10}, h.points2 = {0};
  h.update("scene");
  CHECK(h.maximum == 10);
  h.points2.clear();
  CHECK_THAT(error_of([&] { h.update("scene"); }), Contains("points2 is empty"));
}

TEST_CASE("a mean of points") {
  AverageCoord<Vec3d> a{.position = {{0, 0, 0}, {2, 4, 6}, {9, 9, 9}}, .indices = {0, 1}};
  a.update("scene");
  CHECK(a.average == Eigen::Vector3d(1, 2, 3));
  a.indices = {3};
  CHECK_THAT(error_of([&] { a.update("scene"); }), Contains("AverageCoord<Vec3d>: indices has 3"));
}

}  // namespace test_lists_of_values
