# Runs the program `sinew` (SINEW) in the folder WORK: what it prints, which files it leaves, its exit status.
# The cases are at the end; examples/CMakeLists.txt names them.

file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})

function(fail)
  list(JOIN ARGV "" message)
  message(FATAL_ERROR "${last}: ${message}\n-- output:\n${output}\n-- errors:\n${errors}")
endfunction()

# sinew(STATUS arguments...): runs it; leaves `output` and `errors`
macro(sinew status)
  set(last "sinew ${ARGN}")
  execute_process(COMMAND ${SINEW} ${ARGN} WORKING_DIRECTORY ${WORK} RESULT_VARIABLE result OUTPUT_VARIABLE output
                  ERROR_VARIABLE errors)
  if(NOT result STREQUAL "${status}")
    fail("exit status ${result}, not ${status}")
  endif()
endmacro()
macro(expect_output regex)
  if(NOT output MATCHES "${regex}")
    fail("standard output does not match '${regex}'")
  endif()
endmacro()
macro(expect_error regex)
  if(NOT errors MATCHES "${regex}")
    fail("standard error does not match '${regex}'")
  endif()
endmacro()
macro(expect_silence)
  if(NOT output STREQUAL "" OR NOT errors STREQUAL "")
    fail("is not silent")
  endif()
endmacro()
# exactly these files are in WORK, and none with a temporary name
function(expect_files)
  file(GLOB_RECURSE found RELATIVE ${WORK} ${WORK}/*)
  list(REMOVE_ITEM found one.scn)
  list(SORT found)
  set(wanted ${ARGN})
  list(SORT wanted)
  if(NOT found STREQUAL "${wanted}")
    fail("the files are '${found}', not '${wanted}'")
  endif()
endfunction()
# the value of a member of the JSON object in `output`; Python reads it too, where there is one
find_program(PYTHON python3)
macro(json variable)
  if(CMAKE_VERSION VERSION_GREATER_EQUAL 3.19)
    string(JSON ${variable} ERROR_VARIABLE wrong GET "${output}" ${ARGN})
    if(wrong)
      fail("JSON: ${wrong}")
    endif()
  endif()
  if(PYTHON)
    file(WRITE ${WORK}/output.json "${output}")
    execute_process(COMMAND ${PYTHON} -m json.tool ${WORK}/output.json RESULT_VARIABLE result OUTPUT_QUIET)
    file(REMOVE ${WORK}/output.json)
    if(NOT result EQUAL 0)
      fail("Python cannot read the JSON")
    endif()
  endif()
endmacro()
macro(expect_equal a b)
  if(NOT "${a}" STREQUAL "${b}")
    fail("'${a}' is not '${b}'")
  endif()
endmacro()

# a tetrahedron that hangs from a corner, with a skin of one triangle
function(write_scene file stiffness)
  file(WRITE ${WORK}/${file} "<Node name=\"root\" gravity=\"0 -9.81 0\" dt=\"0.02\">
  <RequiredPlugin name=\"Sofa.Component\"/>
  <Node name=\"body\">
    <EulerImplicitSolver rayleighStiffness=\"0.1\" rayleighMass=\"0.1\"/>
    <CGLinearSolver iterations=\"25\" tolerance=\"1e-9\" threshold=\"1e-9\"/>
    <TetrahedronTopology tetrahedra=\"0 1 2 3\"/>
    <MechanicalObject name=\"dofs\" position=\"0 0 0 1 0 0 0 1 0 0 0 1\"/>
    <UniformMass totalMass=\"1\"/>
    <TetrahedronFEMForceField name=\"fem\" youngModulus=\"${stiffness}\" poissonRatio=\"0.3\"/>
    <FixedConstraint indices=\"0\"/>
    <Node name=\"skin\">
      <OglModel name=\"visual\" position=\"0.1 0.1 0.1 0.2 0.1 0.1 0.1 0.2 0.1\" triangles=\"0 1 2\"/>
      <BarycentricMapping/>
    </Node>
  </Node>
</Node>
")
endfunction()
# a free fall: after n steps of dt by symplectic Euler the speed is -g n dt, bit by bit -1 n dt here
set(fall "<Node name=\"root\" gravity=\"0 -1 0\" dt=\"0.5\"><EulerExplicitSolver/><Node name=\"ball\">
  <MechanicalObject position=\"0 0 0\"/><UniformMass vertexMass=\"2\"/></Node></Node>")
write_scene(one.scn 3000)

if(CASE STREQUAL "usage")
  sinew(0 --help)
  foreach(word run view check list bake compare sweep "Exit status")
    expect_output("${word}")
  endforeach()
  sinew(0 --version)
  expect_output("^sinew [0-9.]+\n$")
  foreach(command run view check list bake compare sweep)
    sinew(0 ${command} --help)
    expect_output("Examples?:  sinew ${command}")
  endforeach()
  sinew(2)
  expect_error("--help")
  sinew(2 walk)
  sinew(2 run)
  expect_error("scene is required")
  sinew(2 run one.scn --fast)
  expect_error("--fast")
  expect_files()

elseif(CASE STREQUAL "run")
  sinew(0 run one.scn)
  expect_output("one.scn: 3 nodes, 9 components, 12 degrees of freedom")
  expect_output("100 steps of 0.02 s")
  expect_output("steps/s, .* times real time")
  expect_output("kinetic energy")
  expect_error("^ignored, without a meaning here: RequiredPlugin\n$")
  sinew(0 run one.scn --quiet --steps 0)
  expect_silence()
  sinew(0 run one.scn --json --time 0.1 --dt 0.01)
  expect_equal("${errors}" "")
  json(steps steps)
  expect_equal(${steps} 10)
  json(ignored ignored 0)
  expect_equal(${ignored} RequiredPlugin)
  # a name that JSON has to escape
  file(WRITE "${WORK}/a \"b\".scn" "${fall}")
  sinew(0 run "a \"b\".scn" --json --steps 4)
  json(energy kineticEnergy)
  expect_equal(${energy} 4) # 2 kg at 2 m/s
  sinew(0 run one.scn --set body/fem.youngModulus=10 --set body/dofs.translation=0\ 5\ 0 --json)
  json(soft potentialEnergy)
  sinew(0 run one.scn --json)
  json(stiff potentialEnergy)
  if(soft STREQUAL stiff)
    fail("--set changes nothing")
  endif()

elseif(CASE STREQUAL "run-outputs")
  sinew(0 run one.scn --steps 4 --every 2 --vtk out/pictures --record states.txt --save end.scn --quiet)
  expect_silence()
  set(series body_skin.pvd body_skin_0000.vtu body_skin_0001.vtu body_skin_0002.vtu)
  list(TRANSFORM series PREPEND out/pictures/)
  expect_files(end.scn states.txt ${series})
  file(READ ${WORK}/out/pictures/body_skin.pvd pvd)
  if(NOT pvd MATCHES "timestep=\"0\".*timestep=\"0.04\".*timestep=\"0.08\"")
    fail("the series has wrong times: ${pvd}")
  endif()
  file(READ ${WORK}/states.txt record)
  if(NOT record MATCHES "^sinew record 1\nframe 0 time 0\nstate Vec3d 4 /body\n0 0 0 0 0 0\n1 0 0 .*\nend 3\n$")
    fail("the record is wrong: ${record}")
  endif()
  # without a skin, the elements; without elements, the points
  file(WRITE ${WORK}/fall.scn "${fall}")
  sinew(0 run fall.scn --steps 2 --vtk fall --record fall.txt)
  if(NOT EXISTS ${WORK}/fall/ball.pvd OR NOT EXISTS ${WORK}/fall/ball_0002.vtu)
    fail("no picture of a body without a skin")
  endif()
  file(READ ${WORK}/fall.txt record)
  string(CONCAT wanted "sinew record 1\nframe 0 time 0\nstate Vec3d 1 /ball\n0 0 0 0 0 0\n"
         "frame 1 time 0.5\nstate Vec3d 1 /ball\n0 -0.25 0 0 -0.5 0\n"
         "frame 2 time 1\nstate Vec3d 1 /ball\n0 -0.75 0 0 -1 0\nend 3\n")
  expect_equal("${record}" "${wanted}")
  # a body that is held, of 2 kg, bears its weight
  file(WRITE ${WORK}/held.scn "<Node gravity='0 -1 0' dt='0.5'><Node name='ball'><EulerExplicitSolver/><MechanicalObject \
position='3 0 0'/><UniformMass totalMass='2'/><FixedConstraint indices='0'/></Node></Node>")
  sinew(0 run held.scn --steps 2 --vtk held --forces held.csv)
  file(READ ${WORK}/held.csv forces)
  string(CONCAT wanted "step,time,kind,body,other,index,x,y,z,nx,ny,nz,fx,fy,fz,tx,ty,tz\n"
         "1,0.5,reaction,/ball,,0,3,0,0,0,0,0,0,2,0,0,0,0\n2,1,reaction,/ball,,0,3,0,0,0,0,0,0,2,0,0,0,0\n")
  expect_equal("${forces}" "${wanted}")
  file(READ ${WORK}/held/ball_0002.vtu picture)
  if(NOT picture MATCHES "contactForce" OR NOT picture MATCHES "reaction" OR NOT picture MATCHES "netForce")
    fail("a picture has no forces")
  endif()

elseif(CASE STREQUAL "run-profile")
  sinew(0 run one.scn --steps 4 --profile --trace trace.json)
  expect_output("phase or component +class +calls +total \\[ms\\] +step \\[us\\] +share +own\nstep +4 ")
  expect_output("\n +body/fem +TetrahedronFEMForceField<Vec3d> +4 ")
  expect_output("wrote trace.json")
  expect_files(trace.json)
  file(READ ${WORK}/trace.json output)
  json(first traceEvents 1 name)
  expect_equal("${first}" step)
  json(leftOut otherData eventsLeftOut)
  expect_equal("${leftOut}" 0)
  string(REGEX MATCHALL "\"name\":\"step\",\"cat\":\"phase\",\"ph\":\"X\"" stepEvents "${output}")
  list(LENGTH stepEvents stepCount)
  expect_equal("${stepCount}" 4)
  sinew(0 run one.scn --steps 4 --profile --json)
  json(phase profile 0 phase)
  expect_equal("${phase}" step)
  json(calls profile 0 calls)
  expect_equal("${calls}" 4)
  sinew(0 run one.scn --steps 4 --trace /dev/null --quiet)
  expect_silence()
  sinew(2 run one.scn --profile --quiet)

elseif(CASE STREQUAL "run-wrong")
  sinew(1 run no.scn)
  expect_error("no.scn: cannot be read")
  file(WRITE ${WORK}/cut.scn "<Node>\n  <Node name='a'>\n")
  sinew(1 run cut.scn)
  expect_error("cut.scn:[0-9]+:[0-9]+: is no well-formed XML")
  file(WRITE ${WORK}/unknown.scn "<Node>\n  <MecanicalObject/>\n  <UniformMas/>\n</Node>")
  sinew(1 run unknown.scn)
  expect_error("unknown.scn:2:3: .*did you mean 'MechanicalObject'.*unknown.scn:3:3: .*'UniformMass'")
  sinew(0 run unknown.scn --lenient --steps 1)
  expect_error("warning: unknown.scn:2:3: ")
  sinew(2 run one.scn --set bodi/fem.youngModulus=1)
  expect_error("--set .*did you mean 'body'")
  sinew(2 run one.scn --set youngModulus)
  expect_error("path.attribute=value")
  sinew(1 run one.scn --set body/fem.youngModulus=-1)
  expect_error("one.scn:9:5: .*youngModulus.* is -1 Pa")
  sinew(1 run one.scn --set body/fem.youngModulus=soft)
  expect_error("one.scn:9:42: .*youngModulus: 'soft' is no number")
  foreach(dt 0 -1 nan inf x)
    sinew(2 run one.scn --dt ${dt})
    expect_error("--dt")
  endforeach()
  sinew(2 run one.scn --time 0)
  sinew(2 run one.scn --steps -1)
  sinew(2 run one.scn --steps 1 --time 1)
  sinew(2 run one.scn --every 0)
  sinew(2 run one.scn --quiet --json)
  sinew(2 run one.scn --data no/such/folder)
  sinew(2 run one.scn --time 1e300)
  expect_error("--time")
  # nothing is simulated where what comes out cannot be written, and nothing is left behind
  file(REMOVE ${WORK}/cut.scn ${WORK}/unknown.scn)
  file(MAKE_DIRECTORY ${WORK}/folder)
  foreach(option --record --forces --save --trace)
    sinew(4 run one.scn ${option} no/such/folder/file)
    expect_error("no/such/folder/file: cannot be written")
    sinew(4 run one.scn ${option} folder)
    expect_error("folder: is a folder")
  endforeach()
  sinew(4 run one.scn --vtk one.scn)
  expect_error("one.scn: cannot be created")
  expect_files()

elseif(CASE STREQUAL "run-warnings")
  # two rods of 1 and 2 m between the same points, and balls that start in each other
  file(WRITE ${WORK}/warned.scn "<Node dt='0.01'>
  <FreeMotionAnimationLoop/>
  <BlockGaussSeidelConstraintSolver maxIterations='20'/>
  <DefaultPipeline/><BruteForceBroadPhase/><BVHNarrowPhase/><DefaultContactManager response='FrictionContactConstraint'/>
  <MinProximityIntersection alarmDistance='0.1' contactDistance='0.01'/>
  <Node name='rods'>
    <EulerExplicitSolver/>
    <MechanicalObject position='0 0 0  0 0 1'/>
    <UniformMass totalMass='4'/>
    <BilateralLagrangianConstraint first_point='0' second_point='1' rest_vector='1 0 0'/>
    <BilateralLagrangianConstraint first_point='0' second_point='1' rest_vector='2 0 0'/>
  </Node>
  <Node name='balls'>
    <EulerExplicitSolver/>
    <MechanicalObject position='5 0 0  5.5 0 0'/>
    <UniformMass totalMass='4'/>
    <SphereCollisionModel radius='0.3' selfCollision='true'/>
  </Node>
</Node>")
  set(overlap "warned.scn: step 1 .time 0.01 s., parts of /root/balls: they start in each other, by 0.1 m, ")
  set(unsolved "warned.scn: step 1 .time 0.01 s., /root: BlockGaussSeidelConstraintSolver: .* not solved after 20 iterations: ")
  set(contradiction "the residual is 1 m.* equation 0 of /root/rods: Bilateral[A-Za-z<>0-9]+ .2 of 2. contradicts other equalities by 1 m")
  sinew(0 run warned.scn --steps 30)
  # each once, and a count
  expect_error("^warning: ${overlap}[^\n]*\nwarning: ${unsolved}[^\n]*${contradiction}[^\n]*\nwarning: [^\n]*\n$")
  expect_error("warning: warned.scn: /root: the constraints are not solved in 30 steps, from step 1 to 30\n$")
  sinew(0 run warned.scn --steps 30 --json)
  expect_equal("${errors}" "")
  json(count warnings 1)
  if(NOT count MATCHES "${unsolved}.*${contradiction}.*in 30 steps, to step 30.$")
    fail("the warning is '${count}'")
  endif()
  sinew(0 run warned.scn --steps 30 --quiet)
  expect_silence()
  # who is told to stop does
  sinew(3 run warned.scn --set BlockGaussSeidelConstraintSolver.stopsUnsolved=true --steps 30)
  expect_error("not solved after 20 iterations.*contradicts other equalities by 1 m")

elseif(CASE STREQUAL "run-diverges")
  # explicit Euler far above its stable step
  file(WRITE ${WORK}/stiff.scn "<Node dt='1'><EulerExplicitSolver/><Node name='body'>
    <MechanicalObject position='0 0 0 2 0 0'/><UniformMass vertexMass='1'/>
    <StiffSpringForceField spring='0 1 1e6 0 1'/></Node></Node>")
  sinew(3 run stiff.scn --record states.txt --save end.scn --steps 1000)
  expect_error("stiff.scn: step [0-9]+ .*/body: .*diverged")
  file(READ ${WORK}/states.txt record)
  if(NOT record MATCHES "\nend [0-9]+\n$" OR record MATCHES "nan" OR EXISTS ${WORK}/end.scn)
    fail("the files are wrong")
  endif()
  sinew(3 run stiff.scn --json --steps 1000)
  json(error errors 0)
  # numbers that are finite, and their squares are not
  file(WRITE ${WORK}/far.scn "<Node gravity='1e200 0 0'><EulerExplicitSolver/><Node name='body'>
    <MechanicalObject position='0 0 0'/><UniformMass vertexMass='1'/></Node></Node>")
  sinew(3 run far.scn --save end.scn)
  expect_error("far.scn: the kinetic energy is not a finite number")
  if(EXISTS ${WORK}/end.scn)
    fail("what diverged was saved")
  endif()
  # and of a scene that is refused
  sinew(1 run stiff.scn --json --set body/UniformMass.vertexMass=-1)
  json(error errors 0)
  json(steps steps)
  expect_equal("${steps}" 0)
  sinew(1 compare stiff.scn stiff.scn --json --set body/UniformMass.vertexMass=-1)
  json(error errors 0)
  sinew(3 compare one.scn stiff.scn --dt 1)
  expect_error("b: stiff.scn: step ")

elseif(CASE STREQUAL "run-interrupted")
  find_program(TIMEOUT timeout)
  if(NOT TIMEOUT)
    message("no program timeout: skipped")
    return()
  endif()
  set(program ${SINEW})
  # in the foreground it sends one signal, not a second one to the group, which would end the program at once
  set(SINEW ${TIMEOUT} --foreground --preserve-status -s INT 3 ${program})
  sinew(130 run one.scn --steps 1000000000 --every 100000 --record states.txt --vtk out --save end.scn)
  expect_output("interrupted; all files are complete")
  file(STRINGS ${WORK}/states.txt last REGEX "^end ")
  if(NOT last)
    fail("the record is not complete")
  endif()
  file(GLOB left ${WORK}/*.tmp* ${WORK}/out/*.tmp*)
  expect_equal("${left}" "")
  set(SINEW ${program})
  sinew(0 check end.scn)

elseif(CASE STREQUAL "pictures")
  sinew(0 run one.scn --steps 4 --every 2 --png out/pictures --size 64x48 --json)
  json(files files 0)
  expect_equal("${files}" "out/pictures (3 pictures)")
  expect_files(out/pictures/000000.png out/pictures/000001.png out/pictures/000002.png)
  file(READ ${WORK}/out/pictures/000002.png head LIMIT 24 HEX)
  expect_equal("${head}" "89504e470d0a1a0a0000000d494844520000004000000030")
  sinew(0 run one.scn --steps 4 --every 2 --gltf out/one.glb --json)
  json(files files 0)
  expect_equal("${files}" "out/one.glb")
  file(READ ${WORK}/out/one.glb head LIMIT 8 HEX)
  expect_equal("${head}" "676c544602000000")
  sinew(4 run one.scn --steps 1 --gltf no/such/folder/one.glb)
  expect_error("no/such/folder/one.glb")
  sinew(2 run one.scn --png out --size 64)
  expect_error("'64' is not of the form WIDTHxHEIGHT")
  sinew(2 run one.scn --png out --size 0x48)
  sinew(4 run one.scn --png out --size 99999x99999)
  expect_error("a picture of 99999 x 99999 pixels is larger than")
  sinew(4 run one.scn --png one.scn)
  expect_error("one.scn")
  # what is seen: a picture with another quantity is another one, and the same again has the same bytes
  foreach(asked "" "--colour;vonMises;--range;0:10" "--arrows;velocities,reactions" "--show;axes,grid" "--hide;body/skin"
                "--clip;1 0 0 0.15" "--camera;3 3 3  0 0 0")
    string(MAKE_C_IDENTIFIER "seen_${asked}" folder)
    sinew(0 run one.scn --steps 2 --every 2 --png ${folder} --size 160x120 --quiet ${asked})
    expect_silence()
    file(SHA256 ${WORK}/${folder}/000001.png hash)
    list(FIND hashes ${hash} place)
    if(NOT place EQUAL -1)
      fail("nothing is seen of ${asked}")
    endif()
    list(APPEND hashes ${hash})
  endforeach()
  sinew(0 run one.scn --steps 2 --every 2 --png again --size 160x120 --quiet)
  file(SHA256 ${WORK}/again/000001.png hash)
  list(FIND hashes ${hash} place)
  if(NOT place EQUAL 0)
    fail("the same picture has other bytes")
  endif()
  sinew(2 run one.scn --png out --colour stress)
  expect_error("--colour: 'stress' is not one of none, displacement, speed, vonMises, strainEnergy, stretch")
  sinew(2 run one.scn --png out --arrows contact)
  expect_error("did you mean 'contacts'?")
  sinew(2 run one.scn --png out --range 5:1)
  expect_error("--range: 5 is not below 1")
  sinew(2 run one.scn --png out --clip "0 0 0 1")
  expect_error("has no direction")
  sinew(2 run one.scn --png out --hide body/bone)
  expect_error("there is no node 'body/bone'")
  sinew(2 run one.scn --png out --camera "0 0 0 0 0 0")
  expect_error("stands in the point that it looks at")
  file(WRITE ${WORK}/style.scn "<Node><VisualStyle displayFlags='showMoon'/><Node name='ball'><MechanicalObject position='0 0 0'/></Node></Node>")
  sinew(0 run style.scn --steps 1 --png out)
  expect_error("style.scn:1:7: <VisualStyle>: displayFlags: 'showMoon' is not known")
  unset(ENV{DISPLAY})
  unset(ENV{WAYLAND_DISPLAY})
  execute_process(COMMAND ${SINEW} view one.scn WORKING_DIRECTORY ${WORK} RESULT_VARIABLE result ERROR_VARIABLE errors)
  set(last "sinew view one.scn")
  if(errors MATCHES "built without a window")
    expect_equal(${result} 2)
  else()
    expect_equal(${result} 4)
    expect_error("there is no display to open a window on.*sinew run --png")
  endif()
  sinew(1 view none.scn)
  expect_error("none.scn")

elseif(CASE STREQUAL "checkpoint")
  # 6 steps are 2 and 4 more, bit by bit
  sinew(0 run one.scn --steps 6 --every 6 --record whole.txt --save whole.scn)
  sinew(0 run one.scn --steps 2 --save middle.scn)
  sinew(0 run middle.scn --steps 4 --every 4 --record rest.txt --save rest.scn)
  file(READ ${WORK}/whole.scn whole)
  file(READ ${WORK}/rest.scn rest)
  expect_equal("${rest}" "${whole}")
  file(STRINGS ${WORK}/whole.txt whole)
  file(STRINGS ${WORK}/rest.txt rest)
  list(SUBLIST whole 7 -1 whole)
  list(SUBLIST rest 7 -1 rest)
  expect_equal("${rest}" "${whole}")

elseif(CASE STREQUAL "check")
  sinew(0 check one.scn)
  expect_output("^one.scn: ok: 3 nodes, 9 components, 12 degrees of freedom\n$")
  sinew(0 check one.scn --quiet)
  expect_silence()
  expect_files()

elseif(CASE STREQUAL "check-wrong")
  sinew(1 check no.scn)
  file(WRITE ${WORK}/wrong.scn "<Node dt='0'>
  <Node name='a'>
    <MechanicalObject position='0 0 x'/>
    <UniformMass vertexMas='1'/>
    <Foo/>
  </Node>
</Node>")
  sinew(1 check wrong.scn)
  foreach(place 1:1 3:23 4:18 5:5) # all of them
    expect_error("wrong.scn:${place}: ")
  endforeach()
  # values out of range, all of them
  file(WRITE ${WORK}/range.scn "<Node>
  <EulerImplicitSolver rayleighMass='-1'/>
  <CGLinearSolver iterations='0'/>
</Node>")
  sinew(1 check range.scn)
  expect_error("range.scn:2:3: .*rayleighMass.*\nrange.scn:3:3: .*iterations")
  # what only shows at init
  file(WRITE ${WORK}/init.scn "<Node>
  <MechanicalObject position='0 0 0'/>
  <UniformMass/>
  <FixedConstraint indices='7'/>
</Node>")
  sinew(1 check init.scn)
  expect_error("init.scn:4:3: .*7")
  file(WRITE ${WORK}/solver.scn "<Node>
  <EulerImplicitSolver/>
  <MechanicalObject position='0 0 0'/>
  <UniformMass/>
</Node>")
  sinew(1 check solver.scn)
  expect_error("solver.scn.*linear solver")
  # a solver that moves nothing is no mistake, and is said
  file(WRITE ${WORK}/idle.scn "<Node>
  <EulerImplicitSolver/>
</Node>")
  sinew(0 check idle.scn)
  expect_error("warning: idle.scn:2:3: .*does nothing")
  # a number of points that cannot be meant, unless it is
  file(WRITE ${WORK}/large.scn "<Node>
  <RegularGridTopology n='100 100 100'/>
  <MechanicalObject/>
</Node>")
  sinew(1 check large.scn)
  expect_error("large.scn:2:3: .*100 x 100 x 100 points would take 2.05 GB, and the limit is 537 MB; .*--max-memory")
  sinew(0 check large.scn --max-memory 4G)
  sinew(1 check large.scn --max-memory 4000)
  expect_error("memory")
  sinew(2 check large.scn --max-memory much)

elseif(CASE STREQUAL "list")
  sinew(0 list)
  expect_output("Masses\n.*UniformMass +Vec3d .*Rigid3d")
  expect_output("ODE solvers\n.*EulerImplicitSolver")
  sinew(0 list TetrahedronFEMForceField)
  foreach(words "force field" "youngModulus" "unit +Pa" "range +greater than -1 and less than 0.5" "default +5000"
                "small, large, polar, gradient")
    expect_output("${words}")
  endforeach()
  sinew(0 list OglModel) # an alias
  expect_output("^VisualModel")
  sinew(2 list UniformMas)
  expect_error("did you mean 'UniformMass'")
  sinew(2 list Qwertyuiop)
  expect_error("'sinew list' shows all")
  sinew(2 list --markdown pages --headers no/such/folder)
  expect_error("no/such/folder")
  sinew(2 list --markdown pages --headers ${HEADERS} --scenes no/such/folder)
  expect_error("no/such/folder")
  sinew(4 list --markdown no/such/folder --headers ${HEADERS} --scenes ${SCENES})

elseif(CASE STREQUAL "page")
  # the reference pages in docs/ are what the program writes, all of them
  file(MAKE_DIRECTORY ${WORK}/pages)
  # examples in them are loaded and stepped
  sinew(0 list --markdown pages --headers ${HEADERS} --scenes ${SCENES})
  file(GLOB names RELATIVE ${WORK}/pages ${WORK}/pages/*.md)
  file(GLOB committed RELATIVE ${PAGES} ${PAGES}/*.md)
  if(NOT names STREQUAL committed)
    fail("docs/components has other pages than 'sinew list --markdown docs/components' writes")
  endif()
  foreach(name ${names})
    file(READ ${WORK}/pages/${name} text)
    file(READ ${PAGES}/${name} old)
    if(NOT text STREQUAL old)
      fail("docs/components/${name} is not up to date; write it with: sinew list --markdown docs/components")
    endif()
  endforeach()

elseif(CASE STREQUAL "bake")
  sinew(0 bake one.scn -o one.hpp)
  file(READ ${WORK}/one.hpp header)
  if(NOT header MATCHES "#pragma once.*TetrahedronFEMForceField<Vec3d>")
    fail("the header is wrong: ${header}")
  endif()
  file(REMOVE ${WORK}/one.hpp)
  sinew(2 bake one.scn)
  sinew(1 bake no.scn -o one.hpp)
  expect_error("no.scn: cannot be read")
  sinew(1 bake one.scn -o one.hpp --set body/fem.poissonRatio=1)
  sinew(4 bake one.scn -o no/such/folder/one.hpp)
  expect_files()

elseif(CASE STREQUAL "compare")
  # the same twice, then something else
  sinew(0 compare one.scn one.scn --steps 10)
  expect_output("/body +4 +0 +0 ")
  expect_output("time a step")
  sinew(0 compare one.scn --set-b body/fem.youngModulus=300 --steps 10 --every 5 --json)
  json(frames frames)
  expect_equal(${frames} 3)
  json(rms bodies 0 rms)
  if(NOT rms GREATER 0)
    fail("softer is not different")
  endif()
  # two step lengths of a free fall: x = -g t (t + dt) / 2, so they are g t (dt - dt') / 2 apart at t
  file(WRITE ${WORK}/fall.scn "${fall}")
  sinew(0 compare fall.scn --set-b root.dt=0.25 --time 2 --json)
  json(distance bodies 0 max)
  expect_equal(${distance} 0.25)
  # a record stands for its scene
  sinew(0 run one.scn --steps 10 --every 5 --record states.txt --quiet)
  sinew(0 compare states.txt one.scn --json)
  json(distance bodies 0 max)
  expect_equal(${distance} 0)
  json(frames frames)
  expect_equal(${frames} 3)
  # bodies that only one has, or of another size
  sinew(0 compare fall.scn one.scn --dt 0.1 --steps 1)
  expect_output("/ball +only in a\n/body +only in b\n")

elseif(CASE STREQUAL "compare-wrong")
  sinew(2 compare one.scn)
  expect_error("--set-b")
  sinew(1 compare one.scn no.scn)
  sinew(2 compare one.scn --set-b root.dt=0.013 --steps 10)
  expect_error("0.013")
  sinew(2 compare one.scn --set-b nobody/fem.youngModulus=1)
  expect_error("nobody")
  sinew(2 compare one.scn --set-a youngModulus)
  sinew(2 compare one.scn one.scn --rounds -1)
  file(WRITE ${WORK}/bad.txt "sinew record 1\nframe 0 time 0\nstate Vec3d 999999999 /body\n0 0\n")
  sinew(1 compare bad.txt one.scn)
  expect_error("bad.txt:3: the number of points")

else()
  message(FATAL_ERROR "there is no case ${CASE}")
endif()
