// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"

#include <sinew/core/error.hpp>

namespace test_error {

using namespace sinew;

TEST_CASE("text joins words, numbers and characters") {
  CHECK(text("a ", 1, ' ', 2.5, ' ', std::string("b"), std::size_t(7)) == "a 1 2.5 b7");
  CHECK(std::string(Error("here", "wrong").what()) == "here: wrong");
  CHECK(std::string(Error("", "wrong").what()) == "wrong");
}

TEST_CASE("a label takes the place of a name where that is mentioned first") {
  CHECK(with_label("/root: Spring<Vec3d>: a Spring<Vec3d> is slack",
                   "Spring<Vec3d>",
                   "Spring<Vec3d> (2 of 3)") == "/root: Spring<Vec3d> (2 of 3): a Spring<Vec3d> is slack");
  CHECK(with_label("/root: it is slack", "Spring<Vec3d>", "Spring<Vec3d> 'left'") == "/root: it is slack");
}

TEST_CASE("the nearest known name is suggested, and none when all are far") {
  const std::vector<std::string> known{"youngModulus", "poissonRatio", "method"};
  CHECK(edit_distance("kitten", "sitting") == 3);
  CHECK(nearest_name("youngsModulus", known) == "youngModulus");
  CHECK(nearest_name("POISSONRATIO", known) == "poissonRatio");
  CHECK(nearest_name("xyz", known).empty());
  CHECK(edit_distance("feild", "Field") == 1);
  CHECK(edit_distance("ca", "abc") == 3);
  CHECK(edit_distance("", "abc") == 3);
}

TEST_CASE("what shares words with a name, but not the word that tells it from others, is another thing") {
  const std::vector<std::string> known{"TetrahedronFEMForceField",
                                       "FixedPlaneConstraint",
                                       "CGLinearSolver",
                                       "MeshOBJLoader",
                                       "IdentityMapping",
                                       "StiffSpringForceField",
                                       "EulerImplicitSolver"};
  for (auto const& [word, name] : {std::pair{"TetrahedronFEMForceFeild", "TetrahedronFEMForceField"},
                                   {"TetrahedronFemForcefield", "TetrahedronFEMForceField"},
                                   {"TetraedronFEMForceField", "TetrahedronFEMForceField"},
                                   {"TetrahedronFEM", "TetrahedronFEMForceField"},
                                   {"EulerImplicit", "EulerImplicitSolver"},
                                   {"cglinearsolver", "CGLinearSolver"},
                                   {"FixedPlaneConstrant", "FixedPlaneConstraint"}})
    CHECK(nearest_name(word, known) == name);
  for (auto const* word : {"BilateralLagrangianConstraint",
                           "BTDLinearSolver",
                           "MeshOffLoader",
                           "IdentityMultiMapping",
                           "JointSpringForceField",
                           "TaitSurfacePressureForceField",
                           "Solver",
                           ""})
    CHECK(nearest_name(word, known).empty());
}

}  // namespace test_error
