"""Reads run.xdmf of a run directory with ParaView's VTK and renders its last snapshot; prints what was found as JSON.

Usage: pvpython render_xdmf.py DIR PICTURE.png
"""

import csv
import json
import os
import sys

import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  registers the renderer
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
from vtkmodules.vtkFiltersCore import vtkAppendPolyData, vtkFeatureEdges, vtkMassProperties
from vtkmodules.vtkFiltersGeometry import vtkGeometryFilter
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkIOXdmf2 import vtkXdmfReader
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow, vtkWindowToImageFilter


def surface_of(block):
    surface = vtkGeometryFilter()
    surface.SetInputDataObject(block)
    surface.Update()
    return surface.GetOutput()


def leaves_of(data):
    if not data.IsA("vtkCompositeDataSet"):
        return [data]
    leaves, iterator = [], data.NewIterator()
    iterator.InitTraversal()
    while not iterator.IsDoneWithTraversal():
        leaves.append(iterator.GetCurrentDataObject())
        iterator.GoToNextItem()
    return leaves


def read_surfaces(path):
    """Times, all vesicles as one surface, and what has no fields: the wall."""
    reader = vtkXdmfReader()
    reader.SetFileName(path)
    reader.UpdateInformation()
    times = reader.GetOutputInformation(0).Get(vtkStreamingDemandDrivenPipeline.TIME_STEPS())
    reader.UpdateTimeStep(times[-1])
    data = reader.GetOutputDataObject(0)
    vesicles, walls = vtkAppendPolyData(), []
    for surface in map(surface_of, leaves_of(data)):
        if surface.GetPointData().GetNumberOfArrays() > 0:
            vesicles.AddInputData(surface)
        else:
            walls.append(surface)
    vesicles.Update()
    return times, vesicles.GetOutput(), walls


def boundary_edges(surface):
    edges = vtkFeatureEdges()
    edges.SetInputData(surface)
    edges.BoundaryEdgesOn()
    edges.NonManifoldEdgesOn()
    edges.FeatureEdgesOff()
    edges.ManifoldEdgesOff()
    edges.Update()
    return edges.GetOutput().GetNumberOfCells()


def triangulated_area(surface):
    properties = vtkMassProperties()
    properties.SetInputData(surface)
    properties.Update()
    return properties.GetSurfaceArea()


def render(surface, field, picture):
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(surface)
    mapper.SetScalarModeToUsePointFieldData()
    mapper.SelectColorArray(field)
    mapper.SetScalarRange(surface.GetPointData().GetArray(field).GetRange())
    actor = vtkActor()
    actor.SetMapper(mapper)
    renderer = vtkRenderer()
    renderer.SetBackground(1.0, 1.0, 1.0)
    renderer.AddActor(actor)
    window = vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetSize(300, 300)
    window.AddRenderer(renderer)
    camera = renderer.GetActiveCamera()
    camera.SetPosition(0.0, -10.0, 2.0)
    camera.SetViewUp(0.0, 0.0, 1.0)
    renderer.ResetCamera()
    window.Render()
    grab = vtkWindowToImageFilter()
    grab.SetInput(window)
    grab.Update()
    writer = vtkPNGWriter()
    writer.SetFileName(picture)
    writer.SetInputConnection(grab.GetOutputPort())
    writer.Write()
    return vtk_to_numpy(grab.GetOutput().GetPointData().GetScalars())


def last_area(directory):
    """Of all vesicles together."""
    several = directory + "/vesicles.csv"
    with open(several if os.path.exists(several) else directory + "/history.csv", newline="") as stream:
        rows = list(csv.DictReader(stream))
    return sum(float(row["area"]) for row in rows if row["time"] == rows[-1]["time"])


def main():
    directory, picture = sys.argv[1:3]
    times, surface, walls = read_surfaces(directory + "/run.xdmf")
    area = last_area(directory)
    point_data = surface.GetPointData()
    pixels = render(surface, "Vm", picture)
    print(json.dumps({
        "times": list(times),
        "points": surface.GetNumberOfPoints(),
        "walls": [{"cells": wall.GetNumberOfCells(), "bounds": list(wall.GetBounds())} for wall in walls],
        "boundary_edges": boundary_edges(surface),
        "area_ratio": triangulated_area(surface) / area,
        "fields": [point_data.GetArrayName(i) for i in range(point_data.GetNumberOfArrays())],
        "foreground_fraction": float((pixels.min(axis=1) < 250).mean()),
        "colours": len({tuple(pixel) for pixel in pixels.tolist()}),
    }))


if __name__ == "__main__":
    main()
