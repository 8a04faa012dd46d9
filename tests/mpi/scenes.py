# SPDX-License-Identifier: BSL-1.0
"""Scenes of tests with several ranks, written into a folder."""
import math
import pathlib
import sys


def grid(n, low, high):
    """Points and hexahedra of a grid of n points a direction."""
    points = [[low[c] + (high[c] - low[c]) * i[c] / (n[c] - 1) for c in range(3)]
              for i in ((x, y, z) for z in range(n[2]) for y in range(n[1]) for x in range(n[0]))]
    at = lambda x, y, z: x + n[0] * (y + n[1] * z)
    cells = [[at(x, y, z), at(x + 1, y, z), at(x + 1, y + 1, z), at(x, y + 1, z),
              at(x, y, z + 1), at(x + 1, y, z + 1), at(x + 1, y + 1, z + 1), at(x, y + 1, z + 1)]
             for z in range(n[2] - 1) for y in range(n[1] - 1) for x in range(n[0] - 1)]
    return points, cells


def border(cells):
    """The triangles around hexahedra, seen from outside."""
    sides = {}
    for c in cells:
        for side in ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)):
            q = [c[i] for i in side]
            key = tuple(sorted(q))
            sides[key] = None if key in sides else q
    return [t for q in sides.values() if q for t in ((q[0], q[1], q[2]), (q[0], q[2], q[3]))]


def words(lists):
    return "  ".join(" ".join(f"{v:.9g}" for v in entry) for entry in lists)


def scene(gravity, dt, inside):
    return f'<Node name="root" gravity="{gravity}" dt="{dt}">\n{inside}</Node>\n'


SOLVERS = {"cg": '<CGLinearSolver iterations="2000" tolerance="1e-12"/>',
           "petsc": '<PetscLinearSolver preconditioner="pbjacobi" tolerance="1e-12"/>'}


def mapped(solver):
    """A bar of hexahedra, with a skin inside its elements that touches a plane and has springs, tips that follow the skin and
    are pulled, a copy that touches a sphere and is held, and a surface that is only looked at."""
    points, cells = grid((9, 3, 3), (0, 0, 0), (4, 1, 1))
    skin, faces = grid((12, 4, 4), (0.05, 0.1, 0.1), (3.9, 0.9, 0.9))
    triangles = border(faces)
    springs = "  ".join(f"{i} {i + 13} 300 1 {0.5 + i / 100:.3g}" for i in range(0, 150, 7))
    edges = "  ".join(f"{a} {b}" for a, b, _ in triangles[::9])
    return scene("0 -9.81 0", 0.01, f"""
  <Node name="bar">
    <EulerImplicitSolver rayleighStiffness="0.01" rayleighMass="0.1"/>
    {SOLVERS[solver]}
    <MeshTopology name="mesh" position="{words(points)}" hexahedra="{words(cells)}"/>
    <MechanicalObject/>
    <DiagonalMass massDensity="100"/>
    <HexahedronFEMForceField youngModulus="2e5" poissonRatio="0.3"/>
    <BoxROI name="held" box="-0.1 -0.1 -0.1  0.1 1.1 1.1" position="@mesh.position"/>
    <FixedConstraint indices="@held.indices"/>
    <Node name="skin">
      <MeshTopology position="{words(skin)}" edges="{edges}" triangles="{words(triangles)}"/>
      <MechanicalObject/>
      <BarycentricMapping/>
      <UniformMass totalMass="30"/>
      <PlaneForceField normal="0 1 0" d="0.09" stiffness="2000" damping="5"/>
      <StiffSpringForceField spring="{springs}"/>
      <MeshSpringForceField stiffness="400" damping="1"/>
      <Node name="tips">
        <MechanicalObject/>
        <SubsetMapping indices="11 23 47 190 100 3 150"/>
        <ConstantForceField totalForce="70 -200 30"/>
        <UniformVelocityDampingForceField dampingCoefficient="2"/>
      </Node>
    </Node>
    <Node name="copy">
      <MechanicalObject/>
      <IdentityMapping/>
      <SphereForceField center="3 -0.6 0.5" radius="0.75" stiffness="1000" damping="1"/>
      <RestShapeSpringsForceField points="8 17 80" stiffness="500"/>
    </Node>
    <Node name="look">
      <OglModel position="{words(skin)}" triangles="{words(triangles)}"/>
      <BarycentricMapping/>
    </Node>
  </Node>
""")


def constraints(solver):
    """Each projective constraint on some points of a bar."""
    points, cells = grid((12, 3, 3), (0, 0, 0), (5.5, 1, 1))
    tetrahedra = tetrahedra_of(cells)
    return scene("0 -9.81 0", 0.01, f"""
  <Node name="bar">
    <EulerImplicitSolver rayleighStiffness="0.01" rayleighMass="0.1"/>
    {SOLVERS[solver]}
    <MeshTopology position="{words(points)}" tetrahedra="{words(tetrahedra)}"/>
    <MechanicalObject/>
    <DiagonalMass massDensity="100"/>
    <TetrahedronFEMForceField youngModulus="1e5" poissonRatio="0.3"/>
    <FixedPlaneConstraint direction="1 0 0" dmin="-0.1" dmax="0.1"/>
    <PartialFixedConstraint indices="13 50" fixedDirections="0 1 0"/>
    <LinearMovementConstraint indices="23 35" keyTimes="0 0.1 0.3" movements="0 0 0  0.1 0.05 0  0.1 -0.1 0"/>
    <LinearVelocityConstraint indices="5 101" keyTimes="0 0.1 0.3" velocities="0 0 0  0.3 0 0.1  0 0 0.2"/>
    <AffineMovementConstraint indices="72 84 96" beginConstraintTime="0" endConstraintTime="1" rotation="1 0 0  0 1 0  0 0 1" translation="0 0.2 0.1"/>
    <OscillatorConstraint oscillators="40 2 0.5 0.5  0 0.1 0  10 0"/>
    <ParabolicConstraint indices="95" P1="0 0 0" P2="0.05 0.1 0" P3="0.1 0 0" BeginTime="0" EndTime="0.5"/>
    <HermiteSplineConstraint indices="107" BeginTime="0" EndTime="0.5" X0="5.5 1 1" dX0="0.1 0.2 0" X1="5.6 1.1 1" dX1="0 0.1 0" SX0="0 0" SX1="1 1"/>
    <ProjectDirectionConstraint indices="18 90" direction="0 1 0.2"/>
    <ProjectToPointConstraint indices="28" point="2 1 0"/>
    <ProjectToLineConstraint indices="65" origin="2.5 1 0.5" direction="0 1 0"/>
    <ProjectToPlaneConstraint indices="55 57" origin="0 0.5 0.5" normal="0 0 1"/>
  </Node>
""")


def contact(solver):
    """Two soft blocks fall on a floor and on each other, with surfaces that follow them. No two edges are parallel: where two
    places are as near, rounding would choose between them."""
    def block(name, low, high):
        points, cells = grid((5, 3, 3), low, high)
        points = [[x + 0.012 * math.sin(37 * i + 11 * c) for c, x in enumerate(p)] for i, p in enumerate(points)]
        surface = border(cells)
        used = sorted({i for t in surface for i in t})
        now = {old: i for i, old in enumerate(used)}
        return f"""
    <Node name="{name}">
      <MeshTopology position="{words(points)}" hexahedra="{words(cells)}"/>
      <MechanicalObject/>
      <UniformMass totalMass="2"/>
      <HexahedronFEMForceField youngModulus="20000" poissonRatio="0.3"/>
      <Node name="surface">
        <MeshTopology triangles="{words([[now[i] for i in t] for t in surface])}"/>
        <MechanicalObject position="{words([points[i] for i in used])}"/>
        <SubsetMapping/>
        <TriangleCollisionModel contactStiffness="10" contactDamping="2"/>
        <LineCollisionModel contactStiffness="10" contactDamping="2"/>
        <PointCollisionModel contactStiffness="10" contactDamping="2"/>
      </Node>
    </Node>"""
    return scene("0 -9.81 0", 0.005, f"""
  <DefaultPipeline/>
  <BruteForceBroadPhase/>
  <BVHNarrowPhase/>
  <MinProximityIntersection alarmDistance="0.05" contactDistance="0.02"/>
  <DefaultContactManager response="PenalityContactForceField"/>
  <Node name="floor">
    <MeshTopology triangles="0 2 1  0 3 2"/>
    <MechanicalObject position="-3 0 -3  3 0 -3  3 0.2 3  -3 0.2 3"/>
    <TriangleCollisionModel moving="false" simulated="false" contactStiffness="200"/>
  </Node>
  <Node name="bodies">
    <EulerImplicitSolver rayleighStiffness="0.02"/>
    {SOLVERS[solver]}
    {block("lower", (-0.4, 0.12, -0.2), (0.4, 0.42, 0.2))}
    {block("upper", (-0.2, 0.45, -0.25), (0.7, 0.75, 0.15))}
  </Node>
""")


def rigid(solver):
    """A bar on which a rigid body hangs by springs, and a second one on that by a joint; the first one carries a surface that
    falls on a floor, and one that is only looked at."""
    points, cells = grid((7, 3, 3), (0, 1, 0), (3, 2, 1))
    box, sides = grid((2, 2, 2), (-0.5, -0.5, -0.5), (0.5, 0.5, 0.5))
    box = [[x + 0.02 * math.sin(17 * i + 5 * c) for c, x in enumerate(p)] for i, p in enumerate(box)]
    return scene("0 -9.81 0", 0.01, f"""
  <DefaultPipeline/>
  <BruteForceBroadPhase/>
  <BVHNarrowPhase/>
  <MinProximityIntersection alarmDistance="0.1" contactDistance="0.05"/>
  <DefaultContactManager response="PenalityContactForceField"/>
  <Node name="floor">
    <MeshTopology triangles="0 2 1  0 3 2"/>
    <MechanicalObject position="-9 0.9 -9  9 0.9 -9  9 1 9  -9 1 9"/>
    <TriangleCollisionModel moving="false" simulated="false" contactStiffness="300"/>
  </Node>
  <Node name="bodies">
    <EulerImplicitSolver rayleighStiffness="0.02"/>
    {SOLVERS[solver]}
    <StiffSpringForceField object1="@soft" object2="@rigids/carried" spring="6 0 20000 10 0.5  20 2 20000 10 0.5  48 4 20000 10 0.5  62 6 20000 10 0.5"/>
    <Node name="soft">
      <MeshTopology name="mesh" position="{words(points)}" hexahedra="{words(cells)}"/>
      <MechanicalObject/>
      <DiagonalMass massDensity="300"/>
      <HexahedronFEMForceField youngModulus="2e5" poissonRatio="0.3"/>
      <BoxROI name="held" box="-0.1 0.9 -0.1  0.1 2.1 1.1" position="@mesh.position"/>
      <FixedConstraint indices="@held.indices"/>
    </Node>
    <Node name="rigids">
      <MechanicalObject template="Rigid3d" position="4 1.5 0.5 0 0 0 1  5.5 1.6 0.5 0 0 0 1" velocity="0 0 0 0 0 0.4  0 0 0 0.5 0 0"/>
      <UniformMass totalMass="40"/>
      <JointSpringForceField spring="BEGIN_SPRING 0 1 FREE_AXIS 0 0 0 0 0 1 KS_T 0 20000 KS_R 0 3000 REST_T 1.5 0.1 0 END_SPRING"/>
      <Node name="carried">
        <MeshTopology triangles="{words(border(sides))}"/>
        <MechanicalObject position="{words(box)}"/>
        <RigidMapping index="0"/>
        <PointCollisionModel contactStiffness="10" contactDamping="1"/>
        <TriangleCollisionModel contactStiffness="10"/>
        <Node name="look">
          <OglModel position="{words(box)}" triangles="{words(border(sides))}"/>
          <IdentityMapping/>
        </Node>
      </Node>
    </Node>
  </Node>
""")


def tetrahedra_of(cells):
    return [[c[i] for i in t] for c in cells for t in ((0, 1, 2, 6), (0, 1, 6, 5), (0, 2, 3, 6), (0, 3, 7, 6), (0, 4, 5, 6), (0, 7, 4, 6))]


def second_order(points, tetrahedra):
    """Points with those amid the edges, and tetrahedra of ten points."""
    points, at = list(points), {}
    def amid(a, b):
        key = min(a, b), max(a, b)
        if key not in at:
            at[key] = len(points)
            points.append([(x + y) / 2 for x, y in zip(points[a], points[b])])
        return at[key]
    edges = (0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3)
    return points, [[*t, *(amid(t[a], t[b]) for a, b in edges)] for t in tetrahedra]


def pyramids_of(points, cells):
    """Points with one amid each hexahedron, and the six pyramids around that."""
    points, pyramids = list(points), []
    for c in cells:
        amid = len(points)
        points.append([sum(points[i][k] for i in c) / 8 for k in range(3)])
        pyramids += [[*(c[i] for i in side), amid] for side in ((1, 2, 3, 0), (7, 6, 5, 4), (4, 5, 1, 0), (5, 6, 2, 1), (6, 7, 3, 2), (7, 4, 0, 3))]
    return points, pyramids


def body(name, points, elements, inside, template=""):
    """A body that is held where x = 0."""
    held = " ".join(str(i) for i, p in enumerate(points) if p[0] == 0)
    lists = " ".join(f'{kind}="{words(of)}"' for kind, of in elements.items())
    at = points if not template else [[*p, 0, 0, 0, 1] for p in points]
    of = f'template="{template}"' if template else ""
    return f"""
    <Node name="{name}">
      <MeshTopology position="{words(points)}" {lists}/>
      <MechanicalObject {of} position="{words(at)}"/>
      {inside}
      <FixedConstraint {of} indices="{held}"/>
    </Node>"""


def together(solver, bodies):
    return scene("0 -9.81 0", 0.01, f"""
  <Node name="all">
    <EulerImplicitSolver rayleighStiffness="0.01" rayleighMass="0.1"/>
    {SOLVERS[solver]}
    {"".join(bodies)}
  </Node>
""")


def bodies(solver):
    """Bodies of each kind of element in space, with the masses and loads that there are."""
    points, cells = grid((9, 3, 3), (0, 0, 0), (4, 1, 1))
    tetrahedra = tetrahedra_of(cells)
    prisms = [[c[i] for i in p] for c in cells for p in ((0, 1, 2, 4, 5, 6), (0, 2, 3, 4, 6, 7))]
    coarse, few = grid((5, 2, 2), (0, 0, 0), (4, 1, 1))
    fine, quadratic = second_order(coarse, tetrahedra_of(few))
    amid, pyramids = pyramids_of(points, cells)
    ends = " ".join(str(i) for i, p in enumerate(points) if p[0] == 4)
    return together(solver, [
        body("hyperelastic", points, {"tetrahedra": tetrahedra}, """<MeshMatrixMass massDensity="100"/>
      <TetrahedronHyperelasticityFEMForceField materialName="StableNeoHookean" ParameterSet="40000 200000"/>
      <EllipsoidForceField center="3 -0.5 0.5" vradius="0.6 0.6 0.4" stiffness="2000" damping="1"/>"""),
        body("viscoelastic", points, {"tetrahedra": tetrahedra}, f"""<DiagonalMass massDensity="100"/>
      <TetrahedronViscoelasticityFEMForceField materialName="SLSMaxwellFirstOrder" ParameterSet="100000 50000 0.1 0.3"/>
      <TorsionForceField indices="{ends}" torque="20" axis="1 0 0" origin="0 0.5 0.5"/>"""),
        body("prisms", points, {"prisms": prisms}, f"""<DiagonalMass massDensity="100"/>
      <PrismFEMForceField youngModulus="2e5" poissonRatio="0.3"/>
      <LinearForceField points="{ends}" times="0 0.03 0.1" forces="0 0 0  0 10 20  0 0 0"/>"""),
        body("pyramids", amid, {"pyramids": pyramids}, f"""<DiagonalMass massDensity="100"/>
      <PyramidFEMForceField youngModulus="2e5" poissonRatio="0.3"/>
      <PolynomialRestShapeSpringsForceField points="{ends}" polynomialDegree="3" polynomialStiffness="100 10 1" initialLength="1"/>"""),
        body("quadratic", fine, {"quadraticTetrahedra": quadratic}, """<MeshMatrixMass massDensity="100"/>
      <QuadraticTetrahedronFEMForceField youngModulus="2e5" poissonRatio="0.3"/>
      <ConicalForceField coneCenter="0 0 0" coneHeight="5 0 0" coneAngle="20" stiffness="50" damping="1"/>""")])


def sheets(solver):
    """Sheets by each law of triangles, quads and shells, a frame of beams, and pressures on them."""
    points, triangles, quads = [], [], []
    n, m = 9, 5
    for j in range(m):
        for i in range(n):
            points.append([i / 4, 0.02 * math.sin(3 * i + 5 * j) * (i > 0), j / 4])
    for j in range(m - 1):
        for i in range(n - 1):
            a, b, c, d = i + n * j, i + 1 + n * j, i + 1 + n * (j + 1), i + n * (j + 1)
            quads.append([a, d, c, b])
            triangles += [[a, c, b], [a, d, c]]
    edges = [[i + n * j, i + 1 + n * j] for j in range(m) for i in range(n - 1)] + [[i + n * j, i + n * (j + 1)] for j in range(m - 1) for i in range(n)]
    pressed = " ".join(str(i) for i in range(5, 30))
    mass = '<DiagonalMass massDensity="5"/>'
    def sheet(name, inside):
        return body(name, points, {"triangles": triangles}, mass + inside)
    def shell(name, elements, inside):
        return body(name, points, elements, '<UniformMass template="Rigid3d" totalMass="2"/>' + inside, "Rigid3d")
    some = " ".join(str(i) for i in range(3, 20))
    return together(solver, [
        sheet("fem", f'<TriangleFEMForceField youngModulus="4000" poissonRatio="0.3"/><TrianglePressureForceField pressure="0 20 5" triangleList="{pressed}"/>'),
        sheet("tensor", '<TriangularTensorMassForceField youngModulus="2000" poissonRatio="0.3"/>'),
        sheet("quadratic", '<TriangularQuadraticSpringsForceField youngModulus="2000" poissonRatio="0.3"/>'),
        sheet("biquadratic", '<TriangularBiquadraticSpringsForceField youngModulus="2000" poissonRatio="0.3"/>'),
        body("quads", points, {"quads": quads}, mass + f"""<QuadBendingFEMForceField youngModulus="4000" poissonRatio="0.3" thickness="0.1"/>
      <QuadPressureForceField pressure="0 20 5" quadList="{some}"/>"""),
        shell("shell", {"triangles": triangles}, '<TriangularShellForceField youngModulus="1e6" poissonRatio="0.3" thickness="0.02"/>'),
        shell("beams", {"edges": edges}, '<BeamFEMForceField youngModulus="1e6" poissonRatio="0.3" radius="0.03"/>')])


ODE_SOLVERS = {"newmark": "<NewmarkImplicitSolver/>", "bdf": '<BDFOdeSolver order="2"/>', "symplectic": "<VariationalSymplecticSolver/>",
               "static": "<StaticSolver/>", "runge_kutta_2": "<RungeKutta2Solver/>", "runge_kutta_4": "<RungeKutta4Solver/>",
               "central": '<CentralDifferenceSolver rayleighMass="0.1"/>', "symplectic_euler": "<EulerExplicitSolver/>"}


def stepped(ode):
    """A bar that one of the ODE solvers steps."""
    points, cells = grid((9, 3, 3), (0, 0, 0), (4, 1, 1))
    bar = body("bar", points, {"hexahedra": cells}, '<DiagonalMass massDensity="100"/><HexahedronFEMForceField youngModulus="1e5" poissonRatio="0.3"/>')
    return scene("0 -9.81 0", 0.001, f"""
  <Node name="all">
    {ODE_SOLVERS[ode]}
    {SOLVERS["cg"]}
    {bar}
  </Node>
""")


def gmsh(n, low, high):
    """A grid of hexahedra as a Gmsh file of version 2.2."""
    points, cells = grid(n, low, high)
    lines = [f"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{len(points)}"]
    lines += [f"{i} {words([p])}" for i, p in enumerate(points, 1)]
    lines += [f"$EndNodes\n$Elements\n{len(cells)}"]
    lines += [f"{e} 5 2 1 1 {' '.join(str(i + 1) for i in c)}" for e, c in enumerate(cells, 1)]
    return "\n".join([*lines, "$EndElements\n"])


def loaded(mesh):
    """A bar of hexahedra from a Gmsh file."""
    return scene("0 -9.81 0", 0.01, f"""
  <MeshGmshLoader name="loader" filename="{mesh}"/>
  <Node name="bar">
    <EulerImplicitSolver rayleighStiffness="0.01"/>
    {SOLVERS["cg"]}
    <MeshTopology name="mesh" src="@../loader"/>
    <MechanicalObject/>
    <DiagonalMass massDensity="100"/>
    <HexahedronFEMForceField youngModulus="1e5" poissonRatio="0.3"/>
    <BoxROI name="held" box="-0.1 -0.1 -0.1  0.1 1.1 1.1" position="@mesh.position"/>
    <FixedConstraint indices="@held.indices"/>
  </Node>
""")


def large():
    """A block of 15,625 hexahedra, which take some ten MB."""
    points, cells = grid((26, 26, 26), (0, 0, 0), (1, 1, 1))
    return scene("0 -9.81 0", 0.01, f"""
  <Node name="block">
    <EulerImplicitSolver rayleighStiffness="0.01"/>
    <CGLinearSolver iterations="1" tolerance="0"/>
    <MeshTopology position="{words(points)}" hexahedra="{words(cells)}"/>
    <MechanicalObject/>
    <UniformMass totalMass="1"/>
    <HexahedronFEMForceField youngModulus="1e5" poissonRatio="0.3"/>
  </Node>
""")


def write(folder):
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    all = {}
    for make, kinds in *((make, SOLVERS) for make in (mapped, constraints, contact, rigid, bodies, sheets)), (stepped, ODE_SOLVERS):
        for kind in kinds:
            path = folder / f"{make.__name__}_{kind}.scn"
            path.write_text(make(kind))
            all[path.stem] = str(path)
    return all


if __name__ == "__main__":
    write(sys.argv[1])
