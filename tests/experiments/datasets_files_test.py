"""What experiments/datasets.json and the table of its molecules in experiments/README.md promise each other, the paper and the packages."""

import csv
import gzip
import json
import os
import pathlib
import re
import subprocess
import unittest

EXPERIMENTS = pathlib.Path(os.environ.get("SMOPT_EXPERIMENTS", pathlib.Path(__file__).resolve().parents[2] / "experiments"))
MOLECULES = json.loads((EXPERIMENTS / "datasets.json").read_text())["molecules"]
PACKAGES = {molecule["source"].get("package") for molecule in MOLECULES} - {None}


def of_suite(suite):
    return [molecule for molecule in MOLECULES if suite in molecule["suites"]]


def table_rows():
    """The cells of each row of the table of molecules, by name."""
    lines = (EXPERIMENTS / "README.md").read_text().splitlines()
    start = next(number for number, line in enumerate(lines) if line.startswith("| name |"))
    rows = {}
    for line in lines[start + 2:]:
        if not line.startswith("|"):
            break
        name, about, atoms, vertices, suites, role, source = (cell.strip() for cell in line.strip("|").split("|"))
        rows[name.strip("`")] = {"about": about, "atoms": int(atoms.replace(" ", "")), "vertices": int(vertices.replace(" ", "")),
                                 "suites": suites.split(", "), "role": role, "source": source}
    return rows


def is_installed(package):
    query = subprocess.run(["dpkg-query", "-W", "-f=${db:Status-Status}", package], capture_output=True, text=True, check=False)
    return query.stdout == "installed"


class Molecules(unittest.TestCase):
    def test_have_names_of_their_own_that_can_be_file_names(self):
        names = [molecule["name"] for molecule in MOLECULES]
        self.assertEqual(len(set(names)), len(names))
        for name in names:
            self.assertRegex(name, r"^[A-Za-z0-9_-]+$")

    def test_of_the_paper_are_its_rows_in_its_order(self):
        with open(EXPERIMENTS / "paper" / "table1.csv", newline="") as file:
            rows = [row["molecule"] for row in csv.DictReader(file)]
        self.assertEqual([molecule["paper_row"] for molecule in of_suite("paper")], rows)

    def test_have_a_row_of_the_paper_unless_they_are_extra(self):
        for molecule in MOLECULES:
            self.assertEqual(molecule["paper_row"] is None, molecule["role"] == "extra", molecule["name"])

    def test_of_the_extended_suite_are_twenty_or_more_of_all_sizes(self):
        rows = table_rows()
        atoms = sorted(rows[molecule["name"]]["atoms"] for molecule in of_suite("extended"))
        self.assertGreaterEqual(len(atoms), 20)
        self.assertTrue(500 <= atoms[0] < 1000 and 160_000 < atoms[-1], atoms)

    def test_that_need_no_network_are_files_of_packages(self):
        for suite in ("default", "quick", "extended"):
            for molecule in of_suite(suite):
                self.assertIn("package", molecule["source"], molecule["name"])

    def test_come_from_packages_that_are_listed(self):
        text = (EXPERIMENTS.parent / "packages.txt").read_text()
        for package in PACKAGES | {"pdb2pqr"}:
            self.assertRegex(text, rf"(?m)^{re.escape(package)}$")

    def test_are_in_the_packages_that_are_installed(self):
        installed = {package for package in PACKAGES if is_installed(package)}
        for molecule in MOLECULES:
            if molecule["source"].get("package") in installed:
                self.assertTrue(pathlib.Path(molecule["source"]["path"]).is_file(), molecule["name"])

    def test_that_are_made_of_pdb_entries_say_of_which(self):
        for molecule in MOLECULES:
            if "file" in molecule["source"]:
                self.assertRegex(molecule["source"]["pdb"], r"^[0-9][A-Z0-9]{3}$")
                self.assertTrue(molecule["source"]["file"].startswith(molecule["name"] + "."))

    def test_of_the_paper_are_on_the_grid_that_gives_its_number_of_vertices(self):
        """Only the 70S ribosome's grid is chosen so; 1 % is what three digits of the spacing allow."""
        with open(EXPERIMENTS / "paper" / "table1.csv", newline="") as file:
            wanted = {row["molecule"]: int(row["vertices_initial"]) for row in csv.DictReader(file)}["70S ribosome"]
        self.assertAlmostEqual(table_rows()["4v5a_70S"]["vertices"] / wanted, 1, delta=0.01)


class TableOfTheReadme(unittest.TestCase):
    def test_has_every_molecule_as_it_is(self):
        rows = table_rows()
        self.assertEqual(list(rows), [molecule["name"] for molecule in MOLECULES])
        for molecule in MOLECULES:
            row = rows[molecule["name"]]
            self.assertEqual((row["about"], row["suites"]), (molecule["about"], molecule["suites"]))
            self.assertTrue(row["role"].startswith(molecule["role"]) and (molecule["paper_row"] or "") in row["role"], row)
            self.assertIn(molecule["source"].get("file") or os.path.basename(molecule["source"]["path"]), row["source"])
            self.assertEqual("pdb2pqr" in row["source"], "prepare" in molecule["source"], row)

    def test_has_the_number_of_atoms_of_each_pqr_file(self):
        rows = table_rows()
        for molecule in MOLECULES:
            path = pathlib.Path(molecule["source"].get("path", ""))
            if path.is_file() and ".pqr" in path.name:
                with (gzip.open if path.suffix == ".gz" else open)(path, "rt") as file:
                    atoms = sum(line.startswith(("ATOM", "HETATM")) for line in file)
                self.assertEqual(rows[molecule["name"]]["atoms"], atoms, molecule["name"])


if __name__ == "__main__":
    unittest.main()
