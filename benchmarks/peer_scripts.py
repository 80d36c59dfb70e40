"""Scripts of peers that `benchmarks.smooth_speed` runs as processes: files in and out, as their users would write them.

The first argument is a .npy, the second the file to write.
"""

from __future__ import annotations

_NETS = """
import sys
import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy
f = np.load(sys.argv[1])
image = vtk.vtkImageData()
image.SetDimensions(*f.shape[::-1])
image.GetPointData().SetScalars(numpy_to_vtk(f.view(np.uint8).ravel()))
net = vtk.vtkSurfaceNets3D()
net.SetInputData(image)
CHOICE
net.SmoothingOn()
net.SetNumberOfIterations(16)
net.SetConstraintScale(2.0)
net.SetRelaxationFactor(0.5)
net.SetOutputMeshTypeToTriangles()
"""
_WRITE = """
writer = vtk.vtkSTLWriter()
writer.SetInputConnection(net.GetOutputPort())
writer.SetFileTypeToBinary()
writer.SetFileName(sys.argv[2])
writer.Write()
"""
_NETS_OF_ONE = _NETS.replace("CHOICE", "net.SetValue(0, 1)")
SURFACE_NETS = _NETS_OF_ONE + _WRITE
# All labels in one mesh, in which neighbours share their walls: half of the triangles of closed surfaces.
NETS_OF_LABELS = _NETS.replace("CHOICE", "net.GenerateValues(int(f.max()), 1, int(f.max()))") + _WRITE
# The same nets, made as lean as ours by quadrics, to the number of triangles in the third argument: no distance is
# checked.
LEAN_NETS = (
    _NETS_OF_ONE
    + """
import fast_simplification
net.Update()
mesh = net.GetOutput()
points = vtk_to_numpy(mesh.GetPoints().GetData())
faces = vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(-1, 3).astype(np.int32)
points, faces = fast_simplification.simplify(points, faces, target_count=int(sys.argv[3]))
corners = points[faces].astype(np.float32)
records = np.zeros(len(faces), dtype=[("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
records["normal"] = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
records["corners"] = corners
with open(sys.argv[2], "wb") as file:
    file.write(bytes(80) + np.uint32(len(faces)).tobytes() + records.tobytes())
"""
)
SERRA = """
import sys
import numpy as np
import serra_mesh
labels = np.load(sys.argv[1])
mesher = serra_mesh.Mesher(taubin=8)
mesher.mesh(labels)
for label in range(1, int(labels.max()) + 1):
    mesher.get(label).save(f"{sys.argv[2]}{label}.ply")
"""
OWN_LABELS = """
import sys
import numpy as np
from infill import smooth_labels
smooth_labels(np.load(sys.argv[1])).save(sys.argv[2])
"""
