# SPDX-License-Identifier: Apache-2.0
"""The notebook of the examples runs from the first cell to the last, and shows the charts of the report."""
import json
import os
import sys
import unittest

import nbclient
import nbformat

from support import EXAMPLES, Case

NOTEBOOK = EXAMPLES / "python" / "treloar.ipynb"


class Notebook(Case):
    def test_it_runs_and_shows_the_report(self):
        kernel = self.folder / "kernels" / "python3"
        kernel.mkdir(parents=True)
        (kernel / "kernel.json").write_text(json.dumps({
            "argv": [sys.executable, "-B", "-m", "ipykernel_launcher", "-f", "{connection_file}"],
            "display_name": "Python 3", "language": "python"}))
        os.environ.update(JUPYTER_PATH=str(self.folder), IPYTHONDIR=str(self.folder / "ipython"),
                          TMPDIR=str(self.folder))
        notebook = nbformat.read(NOTEBOOK, as_version=4)
        self.assertTrue(all(not cell.outputs for cell in notebook.cells if cell.cell_type == "code"),
                        "the notebook is kept without outputs")
        nbclient.NotebookClient(notebook, timeout=200, resources={"metadata": {"path": str(NOTEBOOK.parent)}}).execute()
        cells = [cell for cell in notebook.cells if cell.cell_type == "code"]
        printed = ["".join(output.text for output in cell.outputs if output.output_type == "stream") for cell in cells]
        self.assertIn("neo_hooke", printed[1])
        mine, theirs = (line for line in printed[2].splitlines() if "objective" in line)
        self.assertEqual(mine.partition("objective")[2], theirs.partition("objective")[2])
        shown = cells[-1].outputs[-1].data["text/html"]
        self.assertIn("<iframe sandbox=", shown)
        self.assertIn("vega", shown)
        self.assertIn("<td>", cells[3].outputs[-1].data["text/html"].replace("<th>", "<td>"))


if __name__ == "__main__":
    unittest.main()
