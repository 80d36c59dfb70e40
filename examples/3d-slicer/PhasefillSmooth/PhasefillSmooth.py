"""3D Slicer: the panel "Smooth segments (phasefill)". What it does stands in PhasefillSmoothLib/segments.py."""

from __future__ import annotations

import importlib.util

import ctk
import qt
import slicer
from slicer.ScriptedLoadableModule import (
    ScriptedLoadableModule,
    ScriptedLoadableModuleLogic,
    ScriptedLoadableModuleWidget,
)

METHODS = ("auto", "plain", "refine")
ALL = "all segments, together"


class PhasefillSmooth(ScriptedLoadableModule):
    """What Slicer lists."""

    def __init__(self, parent):
        super().__init__(parent)
        parent.title = "Smooth segments (phasefill)"
        parent.categories = ["Segmentation"]
        parent.dependencies = ["Segmentations"]
        parent.contributors = ["The phasefill developers"]
        parent.helpText = (
            "Makes the closed surfaces of segments smooth, with their volumes kept and their walls shared. "
            "The voxels stay as they are; painting on them makes Slicer's own surfaces again."
        )
        parent.acknowledgementText = "https://github.com/phasefill/phasefill"


class PhasefillSmoothWidget(ScriptedLoadableModuleWidget):
    """The panel."""

    def setup(self):
        super().setup()
        box = ctk.ctkCollapsibleButton()
        box.text = "Smooth"
        self.layout.addWidget(box)
        form = qt.QFormLayout(box)
        self.nodes = slicer.qMRMLNodeComboBox()
        self.nodes.nodeTypes = ["vtkMRMLSegmentationNode"]
        self.nodes.addEnabled = self.nodes.removeEnabled = self.nodes.renameEnabled = False
        self.nodes.setMRMLScene(slicer.mrmlScene)
        self.nodes.connect("currentNodeChanged(vtkMRMLNode*)", self.list_segments)
        self.segments = qt.QComboBox()
        self.method = qt.QComboBox()
        self.method.addItems(METHODS)
        self.run = qt.QPushButton("Smooth")
        self.run.connect("clicked()", self.smooth)
        self.verdict = qt.QLabel()
        self.verdict.wordWrap = True
        form.addRow("Segmentation", self.nodes)
        form.addRow("Segments", self.segments)
        form.addRow("Method", self.method)
        form.addRow(self.run)
        form.addRow(self.verdict)
        self.layout.addStretch(1)
        self.list_segments(self.nodes.currentNode())

    def enter(self):
        """Show the segments that there are now."""
        self.list_segments(self.nodes.currentNode())

    def list_segments(self, node):
        """Fill the list of segments."""
        self.segments.clear()
        self.run.enabled = node is not None
        if node is None:
            return
        segmentation = node.GetSegmentation()
        self.segments.addItem(ALL)
        for segment_id in segmentation.GetSegmentIDs():
            self.segments.addItem(segmentation.GetSegment(segment_id).GetName(), segment_id)

    def smooth(self):
        """Smooth what is chosen, and show the verdict; an error is shown in its place."""
        logic, node = PhasefillSmoothLogic(), self.nodes.currentNode()
        if not logic.is_installed():
            if not slicer.util.confirmOkCancelDisplay(
                "Slicer's Python has no phasefill yet. Install it, about 600 MB?"
            ):
                return
            slicer.util.pip_install("phasefill")
        chosen = self.segments.itemData(self.segments.currentIndex)
        try:
            with slicer.util.WaitCursor():
                lines = logic.smooth(node, chosen and [chosen], method=self.method.currentText)
        except ValueError as error:  # those of phasefill are, too
            lines = [str(error)]
        self.verdict.text = "\n".join(lines)


class PhasefillSmoothLogic(ScriptedLoadableModuleLogic):
    """The work, for the panel and for scripts."""

    def is_installed(self):
        """Tell whether Slicer's Python has phasefill."""
        return importlib.util.find_spec("infill") is not None

    def smooth(self, node, segment_ids=None, **options):
        """Smooth segments of a vtkMRMLSegmentationNode in place and show them; return the verdict, a list of lines."""
        from PhasefillSmoothLib import segments

        report = segments.smooth_segments(node.GetSegmentation(), segment_ids, **options)
        node.CreateDefaultDisplayNodes()
        node.GetDisplayNode().SetPreferredDisplayRepresentationName3D(segments.SURFACE)
        node.Modified()
        return segments.describe(report)
