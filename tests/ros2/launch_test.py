# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
"""The launch files, run against stand-ins for ROS 2's launch packages, which aren't on this machine.

The stand-ins take what the constructors of Humble and Jazzy take (ros2/launch and ros2/launch_ros, branches humble and jazzy) and
nothing else, put texts together as theirs do, and record what would be started.

launch_test.py SOURCE_DIR
"""

import os
import pathlib
import shlex
import shutil
import sys
import tempfile
import types
import unittest

import yaml

SOURCE = pathlib.Path(sys.argv[1]).resolve()
LAUNCH = SOURCE / 'ros2' / 'launch'
WORLDS = SOURCE / 'models' / 'worlds'


class Substitution:
    def __init__(self, perform):
        self.perform = perform


def text(value, context):
    """Text of what launch calls SomeSubstitutionsType: a text, a substitution, or a list of these (and no lists in it)."""
    parts = value if isinstance(value, (list, tuple)) else [value]
    for part in parts:
        if not isinstance(part, (str, Substitution)):
            raise TypeError(f'{part!r} is no text and no substitution')
    return ''.join(part if isinstance(part, str) else part.perform(context) for part in parts)


def launch_configuration(variable_name, *, default=None):
    return Substitution(lambda context: context['arguments'][variable_name])


def environment_variable(name, *, default_value=None):
    return Substitution(lambda context: context['environment'].get(name, default_value))


def path_join(substitutions):
    for part in substitutions:
        if not isinstance(part, (str, Substitution)):
            raise TypeError('PathJoinSubstitution takes no lists before Kilted')
    return Substitution(lambda context: os.path.join(*(text(part, context) for part in substitutions)))


def find_package_share(package):
    return Substitution(lambda context: context['shares'][package])


class DeclareLaunchArgument:
    def __init__(self, name, *, default_value=None, description=None, choices=None):
        self.name, self.default, self.description = name, default_value, description


class IncludeLaunchDescription:
    def __init__(self, launch_description_source, *, launch_arguments=None, condition=None):
        self.source, self.arguments, self.condition = launch_description_source, list(launch_arguments or []), condition


class OpaqueFunction:
    def __init__(self, *, function, args=None, kwargs=None, condition=None):
        self.function = function


class Node:
    def __init__(self, *, executable, package=None, name=None, namespace=None, parameters=None, remappings=None, arguments=None,
                 output=None, condition=None):
        self.executable, self.package, self.parameters, self.condition = executable, package, parameters or [], condition


def install_stand_ins():
    def module(name, **names):
        sys.modules[name] = types.ModuleType(name)
        sys.modules[name].__dict__.update(names)

    module('launch', LaunchDescription=list)
    module('launch.actions', DeclareLaunchArgument=DeclareLaunchArgument, IncludeLaunchDescription=IncludeLaunchDescription,
           OpaqueFunction=OpaqueFunction)
    module('launch.conditions', IfCondition=lambda predicate_expression: predicate_expression)
    module('launch.launch_description_sources', PythonLaunchDescriptionSource=lambda launch_file_path: launch_file_path)
    module('launch.substitutions', EnvironmentVariable=environment_variable, LaunchConfiguration=launch_configuration,
           PathJoinSubstitution=path_join)
    module('launch_ros', __path__=[])
    module('launch_ros.actions', Node=Node)
    module('launch_ros.substitutions', FindPackageShare=find_package_share)


def start(file, given, data=SOURCE):
    """What launching `file` with these arguments starts: (kind, details) in order. `data`: VSA_DATA_DIR, if set."""
    content = pathlib.Path(file).read_text()
    scope = {}
    exec(compile(content, str(file), 'exec'), scope)  # a launch file is a program: launch does the same
    context = {
        'arguments': dict(given),
        'environment': {'VSA_DATA_DIR': str(data)} if data else {},
        'shares': {'vsa_ros2': str(SOURCE / 'ros2'), 'ros_gz_sim': '/ros_gz_sim'},
    }
    started = []
    entities = list(scope['generate_launch_description']())
    while entities:
        entity = entities.pop(0)
        if isinstance(entity, OpaqueFunction):
            entities[:0] = entity.function(context)
            continue
        if isinstance(entity, DeclareLaunchArgument):
            context['arguments'].setdefault(entity.name, text(entity.default, context))
            assert entity.description
            continue
        condition = 'true' if entity.condition is None else text(entity.condition, context)
        if condition not in ('true', 'false'):
            raise ValueError(condition)
        if condition == 'false':
            continue
        if isinstance(entity, Node):
            parameters = {key: text(value, context) for group in entity.parameters for key, value in group.items()}
            started.append((f'{entity.package}/{entity.executable}', parameters))
        else:
            arguments = {key: text(value, context) for key, value in entity.arguments}
            path = text(entity.source, context)
            if path.startswith('/ros_gz_sim/'):
                started.append((path, arguments))
            else:
                declared = {e.name for e in load(path) if isinstance(e, DeclareLaunchArgument)}
                assert set(arguments) <= declared, f'{path} knows only {declared}'
                started += start(path, arguments, data)
    return started


def load(path):
    scope = {}
    exec(compile(pathlib.Path(path).read_text(), str(path), 'exec'), scope)
    return scope['generate_launch_description']()


class LaunchFiles(unittest.TestCase):
    def check(self, started, world, robot, worlds=WORLDS):
        simulator, bridge = started
        self.assertEqual(simulator[0], '/ros_gz_sim/launch/gz_sim.launch.py')
        option, path = shlex.split(simulator[1]['gz_args'])  # as the shell that ros_gz_sim starts
        self.assertEqual((option, path), ('-r', str(worlds / f'{world}.sdf')))
        self.assertIn(f'<uri>model://{robot}</uri>', pathlib.Path(path).read_text(), 'the world has the robot')
        self.assertEqual(bridge[0], 'ros_gz_bridge/parameter_bridge')
        self.assertTrue(yaml.safe_load(pathlib.Path(bridge[1]['config_file']).read_text()))
        self.assertEqual(pathlib.Path(bridge[1]['config_file']).parent.name, robot)

    def test_each_robots_file_starts_its_world_and_its_bridge(self):
        for file, world, robot in (('module', 'module', 'qbmove'), ('bench_free', 'bench_free', 'qbmove_bench_free'),
                                   ('bench_load', 'bench_load', 'qbmove_bench_load'), ('snake', 'snake_flat', 'qbmove_snake')):
            self.check(start(LAUNCH / f'{file}.launch.py', {}), world, robot)

    def test_the_snake_goes_over_other_ground(self):
        self.check(start(LAUNCH / 'snake.launch.py', {'world': 'snake_rubble'}), 'snake_rubble', 'qbmove_snake')

    def test_any_worlds_bridge_is_its_robots(self):
        robots = {'bench_load': 'qbmove_bench_load', 'frank': 'frank', 'frank_table': 'frank', 'gripper_soft': 'qbmove_gripper',
                  'snake_hills': 'qbmove_snake', 'manipulator_3r': 'qbmove_manipulator_3r', 'bench_pole': 'qbmove_bench_pole'}
        for world, robot in robots.items():
            self.check(start(LAUNCH / 'world.launch.py', {'world': world}), world, robot)
        self.check(start(LAUNCH / 'world.launch.py', {}), 'bench_load', 'qbmove_bench_load')

    def test_a_path_with_blanks_and_quotes_stays_one(self):
        with tempfile.TemporaryDirectory(prefix="my ro'bots ") as folder:
            worlds = pathlib.Path(folder, 'models', 'worlds')
            worlds.mkdir(parents=True)
            shutil.copy(WORLDS / 'frank.sdf', worlds)
            self.check(start(LAUNCH / 'world.launch.py', {'world': 'frank'}, folder), 'frank', 'frank', worlds)

    def test_what_does_not_fit_is_told(self):
        def refused(given, message, data=SOURCE, file='world'):
            with self.assertRaisesRegex(RuntimeError, message):
                start(LAUNCH / f'{file}.launch.py', given, data)
        refused({'world': 'atlantis'}, 'world:=atlantis: there is no .*atlantis.sdf .allowed: bench_free, ')
        refused({'robot': 'qbmove_snak'}, 'robot:=qbmove_snak: there is no .*bridge.yaml .allowed: frank, qbmove, ')
        refused({'world': 'frank', 'robot': 'qbmove'}, 'robot:=qbmove: .*frank.sdf has no such model')
        refused({'world': 'frank'}, 'robot:=qbmove_bench_load: .*frank.sdf has no such model', file='bench_load')
        refused({}, 'VSA_DATA_DIR is unset', None)

    def test_the_bridge_alone_needs_no_data(self):
        started = start(LAUNCH / 'world.launch.py', {'simulator': 'false', 'robot': 'frank'}, None)
        self.assertEqual([what for what, _ in started], ['ros_gz_bridge/parameter_bridge'])

    def test_without_a_simulator_only_the_bridge_starts(self):
        self.assertEqual([what for what, _ in start(LAUNCH / 'snake.launch.py', {'simulator': 'false'})],
                         ['ros_gz_bridge/parameter_bridge'])

    def test_every_launch_file_is_among_those_tried(self):
        self.assertEqual({file.name.split('.')[0] for file in LAUNCH.glob('*')},
                         {'world', 'module', 'bench_free', 'bench_load', 'snake'})


if __name__ == '__main__':
    install_stand_ins()
    unittest.main(argv=sys.argv[:1], verbosity=2)
