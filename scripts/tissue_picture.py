"""A surface that `replay` wrote, drawn off screen as rviz shows it: lit, in the colours of src/ros/markers.cpp."""

import dataclasses

import numpy
import vtk
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

SKIN, CUT_FACE, BLADE = (0.54, 0.16, 0.13), (0.88, 0.36, 0.34), (0.75, 0.78, 0.82)  # as in src/ros/markers.cpp
BLADE_HEIGHT = 0.008  # m, likewise
BACKGROUND = (0.92, 0.93, 0.95)  # as in rviz/
TRACE = (0.1, 0.85, 0.2)


@dataclasses.dataclass
class Camera:
    """Looks at a point (m) from a direction and a distance (m); size in pixels."""

    focus: tuple
    away: tuple  # from the focus to the camera, of any length
    distance: float
    size: tuple
    trace: bool = False  # draw the blade's edge as a line over everything, and no blade

    def place(self, renderer):
        away = numpy.array(self.away, float)
        camera = renderer.GetActiveCamera()
        camera.SetFocalPoint(*self.focus)
        camera.SetPosition(*(self.focus + self.distance * away / numpy.linalg.norm(away)))
        camera.SetViewUp(0, 0, 1)
        camera.SetViewAngle(45)
        renderer.ResetCameraClippingRange()


class Surface:
    """Vertices (V x 3, m), triangles (F x 3), and per triangle whether it is a cut face and its tissue's label."""

    def __init__(self, vertices, triangles, cut, label):
        self.vertices, self.triangles, self.cut, self.label = vertices, triangles, cut, label

    @staticmethod
    def read(path):
        data = path.read_bytes()
        end = data.index(b"end_header\n") + len(b"end_header\n")
        counts = {line.split()[1]: int(line.split()[2]) for line in data[:end].decode().splitlines()
                  if line.startswith("element")}
        vertices = numpy.frombuffer(data, "<f4", 3 * counts["vertex"], end).reshape(-1, 3)
        faces = numpy.frombuffer(data, [("n", "u1"), ("v", "<i4", 3), ("cut", "u1"), ("label", "u1")], counts["face"],
                                 end + 12 * counts["vertex"])
        return Surface(vertices.astype(float), faces["v"].copy(), faces["cut"] == 1, faces["label"])

    def with_sharp_rim(self):
        """Skin and cut faces have vertices of their own, so that normals are smooth on both but not across."""
        doubled = numpy.vstack([self.vertices, self.vertices])
        triangles = self.triangles + len(self.vertices) * self.cut[:, None]
        return Surface(doubled, triangles, self.cut, self.label)

    def normals(self):
        """Per vertex, weighted by area as in src/surface/deformed_surface.cpp."""
        a, b, c = (self.vertices[self.triangles[:, i]] for i in range(3))
        area = numpy.cross(b - a, c - a)
        sums = numpy.zeros_like(self.vertices)
        for corner in range(3):
            numpy.add.at(sums, self.triangles[:, corner], area)
        length = numpy.linalg.norm(sums, axis=1, keepdims=True)
        return sums / numpy.where(length > 0.0, length, 1.0)

    def colours(self, of_label):
        colours = numpy.where(self.cut[:, None], CUT_FACE, SKIN)
        for label, colour in of_label.items():
            colours[self.label == label] = colour
        return (255 * colours).astype("u1")


class Blade:
    """The edge in the tissue frame, and the blade above it."""

    def __init__(self, settings, pose):
        q = numpy.array([pose.orientation.w, pose.orientation.x, pose.orientation.y, pose.orientation.z])
        w, x, y, z = q / numpy.linalg.norm(q)
        rotation = numpy.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                                [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                                [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])
        origin = numpy.array([pose.position.x, pose.position.y, pose.position.z])
        back = numpy.array(settings["back"], float)
        self.edge = numpy.array(settings["edge"], float) @ rotation.T + origin
        self.spine = self.edge + BLADE_HEIGHT * (rotation @ back / numpy.linalg.norm(back))


def poly_data(points, cells, as_lines=False):
    data = vtk.vtkPolyData()
    data.SetPoints(vtk.vtkPoints())
    data.GetPoints().SetData(numpy_to_vtk(numpy.ascontiguousarray(points), deep=1))
    array = vtk.vtkCellArray()
    for cell in cells:
        array.InsertNextCell(len(cell), [int(i) for i in cell])
    (data.SetLines if as_lines else data.SetPolys)(array)
    return data


def actor_of(data, colour=None):
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputData(data)
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    material = actor.GetProperty()
    material.SetAmbient(0.3)
    material.SetDiffuse(1.0)
    material.SetSpecular(0.15)
    material.SetSpecularPower(20)
    if colour:
        material.SetColor(*colour)
    return actor


def tissue_actor(surface, of_label):
    surface = surface.with_sharp_rim()
    data = poly_data(surface.vertices, surface.triangles)
    data.GetPointData().SetNormals(numpy_to_vtk(surface.normals(), deep=1))
    data.GetCellData().SetScalars(numpy_to_vtk(surface.colours(of_label), deep=1))
    actor = actor_of(data)
    actor.GetProperty().SetInterpolationToPhong()
    return actor


def blade_actor(blade):
    n = len(blade.edge)
    quads = [(i, i + 1, n + i + 1, n + i) for i in range(n - 1)]
    return actor_of(poly_data(numpy.vstack([blade.edge, blade.spine]), quads), BLADE)


def trace_actor(blade):
    actor = actor_of(poly_data(blade.edge, [range(len(blade.edge))], as_lines=True), TRACE)
    actor.GetProperty().SetLineWidth(2)
    actor.GetProperty().LightingOff()
    return actor


def light(renderer):
    """From the upper left of the camera, so that a dent throws a shade, and a little from the camera itself."""
    renderer.AutomaticLightCreationOff()
    for position, intensity in (((-1.2, 0.6, 1.0), 0.8), ((0.3, 0.2, 1.0), 0.5)):
        lamp = vtk.vtkLight()
        lamp.SetLightTypeToCameraLight()
        lamp.SetPosition(*position)
        lamp.SetFocalPoint(0, 0, 0)
        lamp.SetIntensity(intensity)
        renderer.AddLight(lamp)


def draw(surface, of_label, blade, camera):
    """The picture, height x width x 3."""
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetSize(*camera.size)
    window.SetMultiSamples(8)
    window.SetNumberOfLayers(2)
    tissue, over = vtk.vtkRenderer(), vtk.vtkRenderer()
    tissue.SetBackground(*BACKGROUND)
    over.SetLayer(1)
    over.SetActiveCamera(tissue.GetActiveCamera())
    for renderer in (tissue, over):
        window.AddRenderer(renderer)
    light(tissue)
    tissue.AddActor(tissue_actor(surface, of_label))
    if camera.trace:
        over.AddActor(trace_actor(blade))
    else:
        tissue.AddActor(blade_actor(blade))
    camera.place(tissue)
    window.Render()
    grab = vtk.vtkWindowToImageFilter()
    grab.SetInput(window)
    grab.ReadFrontBufferOff()
    grab.Update()
    image = grab.GetOutput()
    width, height, _ = image.GetDimensions()
    return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, -1)[::-1, :, :3].copy()
