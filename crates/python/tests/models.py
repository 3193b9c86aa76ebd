"""Models of the tests."""

from pathlib import Path

EXAMPLES = Path(__file__).parents[3] / "examples"

#: A block of 2 kg on a level guide, pulled by a force that rises by 10 N in a second. With a load of
#: 2 * 9.81 N and coefficients of 0.3 and 0.2 it lets go at 5.886 N and slides against 3.924 N.
BLOCK = """A block that is pulled until it slides
UNITS/FORCE=NEWTON, MASS=KILOGRAM, LENGTH=METER, TIME=SECOND
ACCGRAV/JGRAV=-9.81
PART/1, GROUND
MARKER/1, PART=1
!                            adams_view_name='BLOCK'
PART/2, MASS=2, CM=20, IP=0.005, 0.005, 0.005
MARKER/20, PART=2
!                            adams_view_name='GUIDE'
JOINT/5, TRANSLATIONAL, I=20, J=1
!                            adams_view_name='RUB'
FRICTION/7, JOINT=5, MU_STATIC=0.3, MU_DYNAMIC=0.2, INPUTS=REACTION_FORCE
, STICTION_TRANSITION_VELOCITY=0.001, MAX_STICTION_DEFORMATION=1E-5
!                            adams_view_name='PULL'
SFORCE/1, TRANSLATIONAL, I=20, J=1, ACTIONONLY, FUNCTION=10*TIME
INTEGRATOR/GSTIFF, SI2, ERROR=1E-6
END
"""

#: A pendulum of 1 kg whose pin rubs; long runs can be interrupted.
PENDULUM = """A pendulum
UNITS/FORCE=NEWTON, MASS=KILOGRAM, LENGTH=METER, TIME=SECOND
ACCGRAV/JGRAV=-9.81
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=1, CM=21, IP=0.01, 0.01, 0.01
MARKER/20, PART=2
MARKER/21, PART=2, QP=1, 0, 0
JOINT/1, REVOLUTE, I=20, J=1
FRICTION/1, JOINT=1, MU_STATIC=0.002, MU_DYNAMIC=0.001, PIN_RADIUS=0.01, FRICTION_ARM=0.01
, BENDING_REACTION_ARM=1, STICTION_TRANSITION_VELOCITY=0.001, MAX_STICTION_DEFORMATION=1E-4
END
"""
