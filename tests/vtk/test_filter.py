"""The filter from Python: every option is a property, and a pipeline gives the bytes of the command line.

test_filter.py TOOL; exit status 77 where VTK's Python modules are missing."""
import os
import re
import subprocess
import sys
import tempfile
import unittest

try:
    from vtkmodules.vtkCommonCore import vtkCommand
    from vtkmodules.vtkCommonDataModel import vtkDataObject
    from vtkmodules.vtkFiltersGeneral import vtkDataSetTriangleFilter
    from vtkmodules.vtkImagingCore import vtkRTAnalyticSource
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader, vtkXMLUnstructuredGridWriter
except ImportError as missing:
    print(f"skipped: VTK's Python modules are not there (Debian: python3-vtk9): {missing}")
    sys.exit(77)
from vtktetlod import vtkTetlodSimplify

TOOL = sys.argv.pop(1)


def write(path, port):
    writer = vtkXMLUnstructuredGridWriter()
    writer.SetFileName(path)
    writer.SetInputConnection(port)
    writer.SetDataModeToAppended()
    writer.EncodeAppendedDataOff()
    writer.Write()
    with open(path, "rb") as file:
        return file.read()


def other_than(value):
    """Within the bounds of the option that has this value by default."""
    if isinstance(value, bool):
        return not value
    if isinstance(value, int):
        return value - 1 if value > 1 else value + 1
    return value / 2 + 0.001


class Filter(unittest.TestCase):
    def test_every_option_is_a_property_and_sets_it_alone(self):
        options = re.findall(r"^  ([a-z-]+): ", str(vtkTetlodSimplify()), re.MULTILINE)
        self.assertGreater(len(options), 20)
        for option in options:
            if option == "warm-start":  # the filter's context forgets its runs: the arrays are others'
                continue
            name = "".join(word.capitalize() for word in option.split("-"))
            if option.startswith("on-"):
                name = "Repair" + name[2:]
            simplify = vtkTetlodSimplify()
            wanted = {each: simplify.GetOption(each) for each in options}
            value = getattr(simplify, "Get" + name)()
            self.assertEqual(value, wanted[option], option)
            wanted[option] = other_than(value)
            getattr(simplify, "Set" + name)(wanted[option])
            self.assertEqual({each: simplify.GetOption(each) for each in options}, wanted, option)
            self.assertEqual(getattr(simplify, "Get" + name)(), wanted[option], option)

    def test_same_bytes_as_the_command_line(self):
        wavelet = vtkRTAnalyticSource()
        wavelet.SetWholeExtent(-8, 8, -8, 8, -8, 8)
        tets = vtkDataSetTriangleFilter()
        tets.SetInputConnection(wavelet.GetOutputPort())
        with tempfile.TemporaryDirectory() as folder:
            original, by_tool, by_filter = (os.path.join(folder, name) for name in ("in.vtu", "a.vtu", "b.vtu"))
            write(original, tets.GetOutputPort())
            subprocess.run([TOOL, original, by_tool, "--rho", "0.1", "--sigma", "0.3", "--quiet"], check=True)
            reader = vtkXMLUnstructuredGridReader()
            reader.SetFileName(original)
            simplify = vtkTetlodSimplify()
            simplify.SetInputConnection(reader.GetOutputPort())
            simplify.SetInputArrayToProcess(0, 0, 0, vtkDataObject.FIELD_ASSOCIATION_POINTS, "RTData")
            simplify.SetRho(0.1)
            simplify.SetSigma(0.3)
            result = write(by_filter, simplify.GetOutputPort())
            with open(by_tool, "rb") as file:
                self.assertEqual(file.read(), result)

    def test_an_error_is_an_event(self):
        simplify, heard = vtkTetlodSimplify(), []
        simplify.AddObserver(vtkCommand.ErrorEvent, lambda *_: heard.append(1))
        simplify.SetRho(2)
        self.assertEqual(len(heard), 1)
        self.assertEqual(simplify.GetRho(), 0.01)


if __name__ == "__main__":
    unittest.main()
