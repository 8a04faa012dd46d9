// SPDX-License-Identifier: BSL-1.0
#include "contact_pile.hpp"

#include <btBulletDynamicsCommon.h>

#include <cmath>
#include <memory>

namespace bench {

namespace {

struct World {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase phase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world{&dispatcher, &phase, &solver, &configuration};
  btBoxShape cube{btVector3(0.5, 0.5, 0.5)};
  btStaticPlaneShape plane{btVector3(0, 0, 1), 0};
  std::vector<std::unique_ptr<btRigidBody>> bodies;

  void add(btCollisionShape& shape, btScalar mass, btTransform const& at) {
    btVector3 inertia(0, 0, 0);
    if (mass > 0) shape.calculateLocalInertia(mass, inertia);
    bodies.push_back(std::make_unique<btRigidBody>(mass, nullptr, &shape, inertia));
    btRigidBody& body = *bodies.back();
    body.setWorldTransform(at);
    body.setFriction(btScalar(std::sqrt(pileFriction)));  // that of a contact is the product
    body.setActivationState(DISABLE_DEACTIVATION);
    world.addRigidBody(&body);
  }
  ~World() {
    for (auto const& body : bodies) world.removeRigidBody(body.get());
  }
};

btScalar answer(btRigidBody const& body, btVector3 const& point, btVector3 const& along) {
  const btVector3 arm = (point - body.getCenterOfMassPosition()).cross(along);
  return body.getInvMass() + arm.dot(body.getInvInertiaTensorWorld() * arm);
}

ContactOfStep contact_of(btRigidBody const& a, btRigidBody const& b, btManifoldPoint const& p) {
  ContactOfStep c;
  const btVector3 n = p.m_normalWorldOnB;
  btVector3 axes[3] = {n, {}, {}};
  btPlaneSpace1(n, axes[1], axes[2]);
  const btVector3 force = (n * p.m_appliedImpulse + p.m_lateralFrictionDir1 * p.m_appliedImpulseLateral1 +
                           p.m_lateralFrictionDir2 * p.m_appliedImpulseLateral2) /
                          btScalar(pileStep);
  const btVector3 now = a.getWorldTransform() * p.m_localPointA - b.getWorldTransform() * p.m_localPointB,
                  before = p.m_positionWorldOnA - p.m_positionWorldOnB;
  c.w = 0;
  for (int i = 0; i < 3; ++i) {
    const std::size_t k = std::size_t(i);
    c.f[k] = double(force.dot(axes[i]));
    c.d[k] = double((i == 0 ? now : now - before).dot(axes[i]));
    c.w += pileStep * pileStep / 3 *
           double(answer(a, p.m_positionWorldOnA, axes[i]) + answer(b, p.m_positionWorldOnB, axes[i]));
  }
  return c;
}

}  // namespace

BulletPile bullet_pile(std::vector<BoxAt> const& boxes) {
  auto all = std::make_shared<World>();
  all->world.setGravity({0, 0, btScalar(-9.81)});
  all->world.getSolverInfo().m_solverMode |= SOLVER_USE_2_FRICTION_DIRECTIONS;
  all->add(all->plane, 0, btTransform::getIdentity());
  auto number = [](double x) { return btScalar(x); };
  for (auto const& [c, q] : boxes)
    all->add(all->cube,
             1,
             btTransform(btQuaternion(number(q[0]), number(q[1]), number(q[2]), number(q[3])),
                         btVector3(number(c[0]), number(c[1]), number(c[2]))));
  return {[all](int iterations) {
            all->world.getSolverInfo().m_numIterations = iterations;
            all->world.stepSimulation(btScalar(pileStep), 0);
          },
          [all] {
            std::vector<ContactOfStep> list;
            for (int i = 0; i < all->dispatcher.getNumManifolds(); ++i) {
              btPersistentManifold const& m = *all->dispatcher.getManifoldByIndexInternal(i);
              for (int k = 0; k < m.getNumContacts(); ++k)
                list.push_back(contact_of(*btRigidBody::upcast(m.getBody0()),
                                          *btRigidBody::upcast(m.getBody1()),
                                          m.getContactPoint(k)));
            }
            return list;
          },
          [all] {
            std::vector<BoxAt> list;
            for (std::size_t i = 1; i < all->bodies.size(); ++i) {  // behind the plane
              const btTransform at = all->bodies[i]->getWorldTransform();
              const btVector3 c = at.getOrigin();
              const btQuaternion q = at.getRotation();
              list.push_back({{double(c.x()), double(c.y()), double(c.z())},
                              {double(q.x()), double(q.y()), double(q.z()), double(q.w())}});
            }
            return list;
          }};
}

}  // namespace bench
