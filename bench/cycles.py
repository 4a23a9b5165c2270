# Renders frames of a glTF scene by Blender's Cycles, for bench/renderers:
#
#   blender --background --factory-startup --python bench/cycles.py -- \
#       SCENE ENVIRONMENT OUTPUT WIDTHxHEIGHT SAMPLES [TURNTABLE]
#
# OUTPUT is a prefix: frames are OUTPUT0001.exr and so on. TURNTABLE turns the camera as glint does.
# Features that glint lacks are off: denoising, adaptive sampling, clamping. The samples of a pixel
# cover its square.
import math
import sys

import bpy
import numpy
from mathutils import Matrix

# Blender 3.4's glTF importer uses a name that numpy 1.24 (Debian 12) no longer has.
numpy.bool = bool

scene_path, environment, output, size, samples, *rest = sys.argv[sys.argv.index("--") + 1 :]
width, height = (int(part) for part in size.split("x"))
frames = int(rest[0]) if rest else 1

bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.import_scene.gltf(filepath=scene_path)
scene = bpy.context.scene
scene.camera = next(thing for thing in scene.objects if thing.type == "CAMERA")

# The importer turns +Y up into +Z up. In the middle of a lat-long Blender has +X, OpenEXR +Z.
world = bpy.data.worlds.new("studio")
world.use_nodes = True
nodes, links = world.node_tree.nodes, world.node_tree.links
picture = nodes.new("ShaderNodeTexEnvironment")
picture.image = bpy.data.images.load(environment)
picture.image.colorspace_settings.name = "Linear"
picture.interpolation = "Linear"
mapping = nodes.new("ShaderNodeMapping")
mapping.inputs["Rotation"].default_value[2] = math.pi / 2
direction = nodes.new("ShaderNodeTexCoord")
links.new(direction.outputs["Generated"], mapping.inputs["Vector"])
links.new(mapping.outputs["Vector"], picture.inputs["Vector"])
links.new(picture.outputs["Color"], nodes["Background"].inputs["Color"])
scene.world = world

scene.render.engine = "CYCLES"
scene.render.resolution_x, scene.render.resolution_y = width, height
scene.render.resolution_percentage = 100
scene.render.use_persistent_data = True
scene.render.image_settings.file_format = "OPEN_EXR"
scene.render.image_settings.color_mode = "RGB"
scene.render.image_settings.color_depth = "32"
scene.render.image_settings.exr_codec = "ZIP"
scene.render.use_stamp = False
scene.view_settings.view_transform = "Raw"
cycles = scene.cycles
cycles.device = "CPU"
cycles.samples = int(samples)
cycles.use_adaptive_sampling = False
cycles.use_denoising = False
cycles.pixel_filter_type = "BOX"
cycles.filter_width = 1.0
cycles.max_bounces = cycles.glossy_bounces = cycles.transmission_bounces = 64
cycles.diffuse_bounces = 64
cycles.transparent_max_bounces = 64
cycles.blur_glossy = 0.0
cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0.0
cycles.caustics_reflective = cycles.caustics_refractive = True

corners = [
    thing.matrix_world @ corner
    for thing in scene.objects
    if thing.type == "MESH"
    for corner in (vertex.co for vertex in thing.data.vertices)
]
middle = [(min(c[k] for c in corners) + max(c[k] for c in corners)) / 2 for k in range(3)]
stand = scene.camera.matrix_world.copy()
around = Matrix.Translation(middle)
for frame in range(frames):
    turn = Matrix.Rotation(2 * math.pi * frame / frames, 4, "Z")
    scene.camera.matrix_world = around @ turn @ around.inverted() @ stand
    scene.render.filepath = f"{output}{frame + 1:04d}.exr"
    bpy.ops.render.render(write_still=True)
