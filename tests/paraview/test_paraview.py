"""The ParaView plugin in pvbatch: its panel is the library's options, and a pipeline gives the bytes of the tool.

pvbatch test_paraview.py FOLDER-OF-THE-PLUGIN'S-BUILD LIBTETLOD TOOL; exit status 77 where ParaView's modules are
missing."""
import ctypes
import glob
import os
import re
import subprocess
import sys
import tempfile
import unittest

try:
    from paraview.simple import (Calculator, FindSource, LoadPlugin, LoadState, ResetSession, SaveState,
                                 Tetrahedralize, Wavelet, XMLUnstructuredGridReader)
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter
except ImportError as missing:
    print(f"skipped: ParaView's Python modules are not there (Debian: python3-paraview): {missing}")
    sys.exit(77)

BUILD, LIBRARY, TOOL = sys.argv[1:4]
PLUGIN, = glob.glob(os.path.join(BUILD, "lib*", "**", "Tetlod.so"), recursive=True)
HERE = os.path.dirname(os.path.abspath(__file__))
DATA = os.environ.get("TETLOD_DATA_DIR") or os.path.join(HERE, "..", "..", "..", "shared", "data")
LoadPlugin(PLUGIN, remote=False, ns=globals())


class Bounds(ctypes.Structure):
    """tetlod_bounds"""
    _fields_ = [("struct_size", ctypes.c_uint32), ("is_integer", ctypes.c_int32), ("least", ctypes.c_double),
                ("most", ctypes.c_double), ("preset", ctypes.c_double)]


def bounds_of(option):
    library, bounds = ctypes.CDLL(LIBRARY), Bounds(struct_size=ctypes.sizeof(Bounds))
    assert library.tetlod_option_bounds(library.tetlod_option_from_name(option.encode()), ctypes.byref(bounds)) == 0
    return bounds


def options_of(simplify):
    """Of the filter itself: name -> value."""
    text = str(simplify.GetClientSideObject())
    return {name: float(value) for name, value in re.findall(r"^  ([a-z-]+): (\S+)$", text, re.MULTILINE)}


def property_of(option):
    name = "".join(word.capitalize() for word in option.split("-"))
    return "Repair" + name[2:] if option.startswith("on-") else name


def write(port, path):
    """As the tool does: ParaView's own writers have other defaults."""
    writer = vtkXMLUnstructuredGridWriter()
    writer.SetFileName(path)
    writer.SetInputConnection(port)
    writer.SetDataModeToAppended()
    writer.EncodeAppendedDataOff()
    writer.Write()


def contents(path):
    with open(path, "rb") as file:
        return file.read()


def bytes_of(simplify):
    simplify.UpdatePipeline()
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "result.vtu")
        write(simplify.GetClientSideObject().GetOutputPort(), path)
        return contents(path)


def bytes_of_tool(path, *options):
    with tempfile.TemporaryDirectory() as folder:
        result = os.path.join(folder, "result.vtu")
        subprocess.run([TOOL, path, result, *options, "--quiet"], check=True)
        return contents(result)


# The presets' names say the effort; the filter's context forgets its runs, so that none starts warm.
NOT_IN_THE_PANEL = {"effort", "warm-start"}


class Plugin(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.generated = os.path.join(self.folder.name, "wavelet.vtu")
        tets = Tetrahedralize(Input=Wavelet(WholeExtent=[-8, 8, -8, 8, -8, 8]))
        tets.UpdatePipeline()
        write(tets.GetClientSideObject().GetOutputPort(), self.generated)

    def tearDown(self):
        ResetSession()
        self.folder.cleanup()

    def simplify(self, path=None, **properties):
        reader = XMLUnstructuredGridReader(FileName=[path or self.generated])
        reader.UpdatePipeline()
        return TetlodSimplify(Input=reader, **properties)

    def test_the_panel_has_the_librarys_options_defaults_and_bounds(self):
        simplify = self.simplify()
        options = options_of(simplify)
        self.assertGreater(len(options), 20)
        for option, value in options.items():
            bounds = bounds_of(option)
            self.assertEqual(value, 0 if option == "threads" else bounds.preset, option)
            if option in NOT_IN_THE_PANEL:
                continue
            panel = simplify.GetProperty(property_of(option))
            self.assertIsNotNone(panel, option)
            limits = panel.SMProperty.GetDomain("range")
            if limits is not None:
                self.assertEqual(limits.GetMinimum(0), bounds.least, option)
                if limits.GetMaximumExists(0):
                    self.assertEqual(limits.GetMaximum(0), bounds.most, option)
            if option != "target-ratio":  # which the preset paper has no use for
                self.assertEqual(panel[0], value, option)

    def test_a_changed_property_is_the_filters(self):
        simplify = self.simplify(Preset="fast")
        for option, bounds in ((name, bounds_of(name)) for name in options_of(simplify)):
            if option in NOT_IN_THE_PANEL:
                continue
            flipped = 1 - int(bounds.preset)
            is_switch = bounds.is_integer and bounds.most == 1
            value = flipped if is_switch else 3 if bounds.is_integer else bounds.most / 4
            setattr(simplify, property_of(option), value)
            simplify.UpdateVTKObjects()
            self.assertEqual(options_of(simplify)[option], value, option)

    def test_a_preset_says_how_the_size_is_found_and_changes_nothing_else(self):
        simplify = self.simplify(Rho=0.1, Lambda=0.2, TargetRatio=0.3)
        before = options_of(simplify)
        for preset, ratio, effort in (("paper", 0, 2), ("fast", 0.3, 1), ("accurate", 0.3, 2), ("paper", 0, 2)):
            simplify.Preset = preset
            simplify.UpdateVTKObjects()
            self.assertEqual(options_of(simplify), {**before, "target-ratio": ratio, "effort": effort}, preset)

    def test_same_bytes_as_the_command_line(self):
        by_panel = self.simplify(Scalars=["POINTS", "RTData"], Rho=0.1, Sigma=0.3)
        self.assertEqual(bytes_of(by_panel), bytes_of_tool(self.generated, "--rho", "0.1", "--sigma", "0.3"))
        by_panel.Preset = "fast"
        by_panel.TargetRatio = 0.2
        self.assertEqual(bytes_of(by_panel), bytes_of_tool(self.generated, "--preset", "fast", "--target-ratio", "0.2"))
        by_panel.Preset = "paper"
        by_panel.MaxError = 0.05
        self.assertEqual(bytes_of(by_panel), bytes_of_tool(self.generated, "--max-error", "0.05"))

    def test_same_bytes_as_the_command_line_where_several_arrays_steer(self):
        calculator = Calculator(Input=XMLUnstructuredGridReader(FileName=[self.generated]), ResultArrayName="height",
                                Function="coordsX^2")
        calculator.UpdatePipeline()
        path = os.path.join(self.folder.name, "two.vtu")
        write(calculator.GetClientSideObject().GetOutputPort(), path)
        options = ("--field", "RTData", "--preset", "fast", "--target-ratio", "0.2")
        by_panel = self.simplify(path, Scalars=["POINTS", "RTData"], Preset="fast", TargetRatio=0.2)
        alone = bytes_of(by_panel)
        self.assertEqual(alone, bytes_of_tool(path, *options))
        by_panel.SteeringArrays = ["height", "2.5"]
        both = bytes_of(by_panel)
        self.assertEqual(both, bytes_of_tool(path, *options, "--steer", "height:2.5"))
        self.assertNotEqual(both, alone)
        by_panel.SteeringArrays = []
        self.assertEqual(bytes_of(by_panel), alone)

    def test_same_bytes_as_the_command_line_on_a_real_set(self):
        path = os.path.join(DATA, "bluntfin.vtu")
        if not os.path.exists(path):
            self.skipTest(f"there is no {path}")
        by_panel = self.simplify(path, Preset="fast", TargetRatio=0.09, MeasureError=1)
        self.assertEqual(bytes_of(by_panel), bytes_of_tool(path, "--preset", "fast", "--target-ratio", "0.09"))
        by_panel.UpdatePropertyInformation()
        self.assertGreater(by_panel.GetProperty("ErrorRMS")[0], 0)

    def test_a_state_file_gives_the_same_bytes(self):
        simplify = self.simplify(registrationName="simplified", Preset="accurate", TargetRatio=0.2, Rho=0.2)
        simplify.Preset = "fast"
        expected, path = bytes_of(simplify), os.path.join(self.folder.name, "state.pvsm")
        SaveState(path)
        ResetSession()
        LoadState(path)
        again = FindSource("simplified")
        self.assertEqual(again.Preset, "fast")
        self.assertEqual(bytes_of(again), expected)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
