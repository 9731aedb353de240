# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""A real ROS 2 beside a running world: the package's own launch file starts the real bridge, a node listens and commands.

live_test.py SOURCE_DIR VSA

Left out (exit code 77) where there is no ROS 2 with `ros2 launch` and a ros_gz_bridge that speaks the embedded engine's transport.
"""

import math
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import yaml

SOURCE, VSA = pathlib.Path(sys.argv[1]).resolve(), sys.argv[2]
TRANSPORT = 'libignition-transport11'
PATIENCE_S = 60


def left_out(why):
    print(f'left out: {why}')
    sys.exit(77)


def find_ros():
    """Leaves the test out unless the environment (a sourced setup file) has a ROS 2 that fits."""
    bridges = [pathlib.Path(prefix) / 'lib' / 'ros_gz_bridge' / 'parameter_bridge'
               for prefix in os.environ.get('AMENT_PREFIX_PATH', '').split(':') if prefix]
    bridge = next((file for file in bridges if file.exists()), None)
    if bridge is None:
        left_out('AMENT_PREFIX_PATH leads to no ros_gz_bridge')
    if shutil.which('ros2') is None:
        left_out("there is no 'ros2' on the PATH")
    if TRANSPORT not in subprocess.run(['ldd', str(bridge)], capture_output=True, text=True).stdout:
        left_out(f'{bridge} does not use {TRANSPORT}, as the embedded engine does')


find_ros()
WORK = tempfile.TemporaryDirectory(prefix='vsa_ros2_')
# Alone: nobody else's ROS nodes, Gazebo topics or logs.
os.environ.update(ROS_DOMAIN_ID=str(1 + os.getpid() % 100), ROS_LOCALHOST_ONLY='1', ROS_LOG_DIR=WORK.name + '/log',
                  IGN_PARTITION=f'vsa_ros2_{os.getpid()}', IGN_IP='127.0.0.1')
try:
    import rclpy
    from actuator_msgs.msg import Actuators
    from rclpy.parameter import Parameter
    from rosgraph_msgs.msg import Clock
    from sensor_msgs.msg import JointState
    from std_msgs.msg import Float64
    from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint
except ImportError as error:
    left_out(f'this Python has no {error.name}')


def install_package():
    """vsa_ros2 as its CMakeLists.txt installs it, in a prefix of its own."""
    prefix = pathlib.Path(WORK.name) / 'prefix'
    share = prefix / 'share' / 'vsa_ros2'
    for folder in ('launch', 'config'):
        shutil.copytree(SOURCE / 'ros2' / folder, share / folder)
    shutil.copy(SOURCE / 'ros2' / 'package.xml', share)
    index = prefix / 'share' / 'ament_index' / 'resource_index' / 'packages'
    index.mkdir(parents=True)
    (index / 'vsa_ros2').touch()
    os.environ['AMENT_PREFIX_PATH'] = f"{prefix}:{os.environ['AMENT_PREFIX_PATH']}"


class Side:
    """A program beside the test, with its output in a file; it is interrupted at the end as Ctrl-C would."""

    def __init__(self, name, command):
        self.log = pathlib.Path(WORK.name) / f'{name}.log'
        with self.log.open('w') as log:
            self.process = subprocess.Popen(command, stdout=log, stderr=subprocess.STDOUT, start_new_session=True)

    def stop(self):
        if self.process.poll() is None:
            os.killpg(self.process.pid, signal.SIGINT)
        try:
            self.process.wait(PATIENCE_S)
        finally:
            if self.process.poll() is None:
                os.killpg(self.process.pid, signal.SIGKILL)
                self.process.wait()


class Live:
    """A world with the embedded engine in real time, the launch file's bridge, and a node of this test."""

    world = robot = None
    launch = ('world.launch.py',)

    @classmethod
    def setUpClass(cls):
        cls.sides = []
        cls.addClassCleanup(lambda: [side.stop() for side in reversed(cls.sides)])
        cls.start('vsa', VSA, 'run', cls.world, '--realtime')
        cls.start('launch', 'ros2', 'launch', 'vsa_ros2', *cls.launch, 'simulator:=false')
        rclpy.init()
        cls.addClassCleanup(rclpy.shutdown)
        cls.node = rclpy.create_node('vsa_live_test')
        cls.addClassCleanup(cls.node.destroy_node)

    @classmethod
    def start(cls, name, *command):
        cls.sides.append(Side(name, command))
        return cls.sides[-1]

    def until(self, condition, what):
        """Lets the node work until the condition gives something true; tells what the programs said where it doesn't."""
        end = time.monotonic() + PATIENCE_S
        while time.monotonic() < end:
            rclpy.spin_once(self.node, timeout_sec=0.1)
            found = condition()
            if found:
                return found
        said = ''.join(f'\n--- {side.log.name}\n{side.log.read_text()[-2000:]}' for side in self.sides)
        self.fail(f'{what}: not within {PATIENCE_S} s{said}')

    def listen(self, kind, name):
        """List that grows by what comes on a topic of the robot."""
        heard = []
        subscription = self.node.create_subscription(kind, f'/{self.robot}/{name}', heard.append, 10)
        self.addCleanup(self.node.destroy_subscription, subscription)
        return heard

    def test_every_line_of_its_bridge_works(self):
        # Each topic to ROS brings a message, each topic from ROS has the bridge for a listener.
        kinds = {'Clock': Clock, 'Float64': Float64, 'JointState': JointState}
        config = yaml.safe_load((SOURCE / 'ros2' / 'config' / self.robot / 'bridge.yaml').read_text())
        silent = {entry['ros_topic_name']: kinds[entry['ros_type_name'].split('/')[-1]] for entry in config
                  if entry['direction'] == 'GZ_TO_ROS'}
        deaf = {entry['ros_topic_name'] for entry in config if entry['direction'] == 'ROS_TO_GZ'}
        self.assertTrue(silent and deaf)

        def hear(name):
            return lambda _: silent.pop(name, None)

        for name, kind in list(silent.items()):
            self.addCleanup(self.node.destroy_subscription, self.node.create_subscription(kind, name, hear(name), 10))
        self.until(lambda: not silent, silent)  # when it fails, those that brought nothing
        self.until(lambda: all(self.node.count_subscribers(name) == 1 for name in deaf), f'a listener on each of {deaf}')

    def command(self, name, message, reached, what):
        """Sends until it shows: the bridge's own way to the robot may not have been found yet."""
        publisher = self.node.create_publisher(type(message), f'/{self.robot}/{name}', 10)
        self.addCleanup(self.node.destroy_publisher, publisher)

        def send_and_look():
            if publisher.get_subscription_count() > 0:
                publisher.publish(message)
            return reached()

        self.until(send_and_look, what)


def seconds(stamp):
    return stamp.sec + stamp.nanosec * 1e-9


class State:
    """One JointState as numbers of one actuator."""

    def __init__(self, message, actuator):
        at = message.name.index(actuator)
        motors = [message.position[message.name.index(f'{actuator}_motor_{n}')] for n in (1, 2)]
        self.t_s, self.position_rad = seconds(message.header.stamp), message.position[at]
        self.velocity_rad_s, self.effort_Nm = message.velocity[at], message.effort[at]
        # The qbmove's law: where the motors' mean is, the spring pulls nothing; half their difference is the preset.
        self.equilibrium_rad, self.preset_rad = sum(motors) / 2, (motors[0] - motors[1]) / 2


class Bench(Live, unittest.TestCase):
    world, launch, robot = 'bench_load', ('bench_load.launch.py',), 'qbmove_bench_load'

    def setUp(self):
        self.states = self.listen(JointState, 'joint_states')

    def last(self):
        return State(self.states[-1], 'shaft') if self.states else None

    def at(self, equilibrium_rad=None, preset_rad=None):
        """Whether motors got there, as near as their stiff but finite position loops hold them under load."""
        def look():
            state = self.last()
            return state and (equilibrium_rad is None or abs(state.equilibrium_rad - equilibrium_rad) < 0.05) and (
                preset_rad is None or abs(state.preset_rad - preset_rad) < 0.05)
        return look

    def test_joint_states_tell_of_shaft_and_motors_in_simulated_time(self):
        clock = []
        self.addCleanup(self.node.destroy_subscription, self.node.create_subscription(Clock, '/clock', clock.append, 10))
        self.until(lambda: len(self.states) > 100, 'a hundred joint states')
        for message in self.states:
            self.assertEqual(message.name, ['shaft', 'shaft_motor_1', 'shaft_motor_2'])
            self.assertEqual([len(message.position), len(message.velocity), len(message.effort)], [3, 3, 3])
        stamps = [seconds(message.header.stamp) for message in self.states]
        for before, after in zip(stamps, stamps[1:]):
            hundredths = (after - before) * 100
            self.assertGreater(hundredths, 0.5)
            self.assertAlmostEqual(hundredths, round(hundredths), places=4, msg='100 Hz of simulated time')
        self.until(lambda: clock and seconds(clock[-1].clock) > stamps[-1], '/clock to pass the last state')

    def test_a_float64_turns_the_shaft_until_the_effort_holds_the_load(self):
        self.command('shaft/cmd_preset', Float64(data=0.6), self.at(preset_rad=0.6), 'preset 0.6')
        self.command('shaft/cmd_equilibrium', Float64(data=0.5), self.at(equilibrium_rad=0.5), 'equilibrium 0.5')
        # 1 kg on a lever of 0.15 m (models/robots.toml), hanging at 0 rad.
        self.until(lambda: abs(self.last().velocity_rad_s) < 0.002
                   and abs(self.last().effort_Nm - 1.0 * 9.81 * 0.15 * math.sin(self.last().position_rad)) < 0.04, 'rest')
        self.assertGreater(self.last().position_rad, 0.3)

    def test_a_preset_from_ros_stiffens_the_joint(self):
        stiffness = self.listen(Float64, 'shaft/stiffness')
        self.command('shaft/cmd_equilibrium', Float64(data=0.0), self.at(equilibrium_rad=0.0), 'equilibrium 0')
        self.command('shaft/cmd_preset', Float64(data=0.2), lambda: stiffness and stiffness[-1].data < 1.5, 'soft, Nm/rad')
        self.command('shaft/cmd_preset', Float64(data=0.6), lambda: stiffness[-1].data > 8, 'stiff, Nm/rad')

    def test_actuators_set_equilibrium_and_preset_together(self):
        self.command('cmd_array', Actuators(position=[-0.4, 0.3]),
                     self.at(-0.4, 0.3), 'equilibrium -0.4, preset 0.3')

    def test_a_trajectory_of_several_points_goes_evenly_in_simulated_time(self):
        def point(rad, sec):
            at = JointTrajectoryPoint(positions=[rad, 0.5])
            at.time_from_start.sec = sec
            return at

        names = ['shaft', 'shaft_preset']
        self.command('cmd', JointTrajectory(joint_names=names, points=[point(-0.6, 0)]), self.at(-0.6), 'one point')
        self.states.clear()
        publisher = self.node.create_publisher(JointTrajectory, f'/{self.robot}/cmd', 10)
        self.addCleanup(self.node.destroy_publisher, publisher)
        self.until(lambda: publisher.get_subscription_count() > 0, 'the bridge to listen')
        publisher.publish(JointTrajectory(joint_names=names, points=[point(-0.5, 1), point(0.5, 3), point(0.6, 4)]))
        self.until(self.at(0.6), 'the last point')
        way = [State(message, 'shaft') for message in self.states]
        first, last = (min(way, key=lambda state: abs(state.equilibrium_rad - rad)) for rad in (-0.4, 0.4))
        slope = (last.equilibrium_rad - first.equilibrium_rad) / (last.t_s - first.t_s)
        self.assertAlmostEqual(slope, 0.5, delta=0.05, msg='rad per simulated second')

    def test_the_commands_of_the_page_work_as_they_stand(self):
        page = (SOURCE / 'docs' / 'howto' / 'ros2.md').read_text()
        echo = re.search(r'^(ros2 topic echo \S+)', page, re.M).group(1)
        publish = re.search(r'^(ros2 topic pub .+)$', page, re.M).group(1)
        said = subprocess.run(f'{echo} --once', shell=True, capture_output=True, text=True, timeout=PATIENCE_S)
        self.assertIn('- shaft_motor_2', said.stdout, said.stderr)
        self.command('shaft/cmd_equilibrium', Float64(data=0.0), self.at(0.0), 'equilibrium 0')
        sent = subprocess.run(publish, shell=True, capture_output=True, text=True, timeout=PATIENCE_S)
        self.assertEqual(sent.returncode, 0, sent.stderr)
        self.until(self.at(0.5), "what the page's command asks for")


class Snake(Live, unittest.TestCase):
    world, launch, robot = 'snake_flat', ('snake.launch.py',), 'qbmove_snake'

    def test_the_wave_of_the_page_runs_over_the_snake(self):
        page = (SOURCE / 'docs' / 'howto' / 'ros2.md').read_text()
        wave = pathlib.Path(WORK.name) / 'wave.py'
        wave.write_text(re.search(r'^```python\n(.*?)^```', page, re.M | re.S).group(1))
        states = self.listen(JointState, 'joint_states')
        self.start('wave', sys.executable, str(wave), '--ros-args', '-p', 'use_sim_time:=true')
        self.until(lambda: states and abs(State(states[-1], 'joint_11').preset_rad - 0.6) < 0.05, 'the presets to follow')
        states.clear()
        self.until(lambda: len(states) > 2 and seconds(states[-1].header.stamp) > seconds(states[0].header.stamp) + 4.5, 'two waves')
        phases = []
        for n in range(12):
            amplitude_rad, phase_rad = wave_of([State(message, f'joint_{n}') for message in states], 0.5)
            # 0.5 is asked for; the joints in the middle carry most and stay behind most.
            self.assertTrue(0.3 < amplitude_rad < 0.55, f'joint_{n}: {amplitude_rad}')
            phases.append(phase_rad)
        lags = [(phases[n] - phases[n + 1]) % (2 * math.pi) for n in range(11)]
        self.assertTrue(all(0.2 < lag < 1.0 for lag in lags), lags)
        self.assertAlmostEqual(sum(lags) / 11, 0.6, delta=0.03, msg='rad a joint')


def wave_of(states, frequency_Hz):
    """Amplitude and phase of the equilibrium at this frequency, over the first two periods."""
    states = [state for state in states if state.t_s < states[0].t_s + 2 / frequency_Hz]
    turns = [(state.equilibrium_rad, 2 * math.pi * frequency_Hz * state.t_s) for state in states]
    sine = sum(rad * math.sin(angle) for rad, angle in turns) * 2 / len(turns)
    cosine = sum(rad * math.cos(angle) for rad, angle in turns) * 2 / len(turns)
    return math.hypot(sine, cosine), math.atan2(cosine, sine)


# The other robots, by the launch file for any of them.
for other_world, other_robot in (('module', 'qbmove'), ('bench_free', 'qbmove_bench_free'), ('bench_throw', 'qbmove_bench_throw'),
                                 ('bench_pole', 'qbmove_bench_pole'),
                                 ('gripper_soft', 'qbmove_gripper'), ('manipulator_3r', 'qbmove_manipulator_3r'), ('frank', 'frank')):
    name = other_world.title().replace('_', '')
    globals()[name] = type(name, (Live, unittest.TestCase), {'world': other_world, 'robot': other_robot,
                                           'launch': ('world.launch.py', f'robot:={other_robot}')})


class Robots(unittest.TestCase):
    def test_every_robot_with_a_bridge_is_tried(self):
        tried = {kind.robot for kind in Live.__subclasses__()}
        self.assertEqual(tried, {folder.name for folder in (SOURCE / 'ros2' / 'config').iterdir()})


if __name__ == '__main__':
    install_package()
    unittest.main(argv=sys.argv[:1], verbosity=2)
