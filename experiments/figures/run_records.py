"""The records of a run, and what the figures ask of them."""

import json


def read_records(folder):
    records = {}
    for file in sorted(folder.glob("*/*.json")):
        record = json.loads(file.read_text(encoding="utf-8"))
        records[record["molecule"]["name"], record["method"]] = record
    return records


def is_done(record):
    return record is not None and record["status"] == "done"


def number(record, *keys):
    """The value at a path of keys; None where the case failed or has no such number."""
    value = record if is_done(record) else None
    for key in keys:
        value = value.get(key) if isinstance(value, dict) else None
    return value


def steps_until_divergence(record):
    """None where the method did not diverge."""
    return number(record, "diverged_at_step")


PAPER_COLUMNS = ("initial", "smopt", "iso2mesh")


def paper_first(methods):
    """The paper's columns, then the others in their order."""
    return sorted(methods, key=lambda method: PAPER_COLUMNS.index(method) if method in PAPER_COLUMNS else len(PAPER_COLUMNS))


class Run:
    """The records with the order in which molecules and methods are shown."""

    def __init__(self, records, molecules, methods, compared):
        self.records = records
        self.molecules = molecules or sorted({molecule for molecule, _ in records})
        self.methods = paper_first(methods or sorted({method for _, method in records}))
        self.compared = compared or sorted({method for _, method in records}, key=lambda name: (name != "initial", name != "smopt", name))

    def record(self, molecule, method):
        return self.records.get((molecule, method))

    def of(self, molecules):
        """The same run as if it had these molecules only."""
        return Run(self.records, molecules, self.methods, self.compared)

    def paper_molecules(self):
        return [molecule for molecule in self.molecules if self.records_of(molecule)[0]["molecule"].get("paper_row")]

    def records_of(self, molecule):
        return [self.records[molecule, method] for method in self.methods if (molecule, method) in self.records]

    def molecule_title(self, molecule):
        block = self.records_of(molecule)[0]["molecule"]
        labels = {"stand-in": " (stand-in)", "near-copy": " (near copy)"}
        return block["title"] + labels.get(block["role"], "")

    def method_title(self, method):
        titles = [record["method_title"] for (_, name), record in self.records.items() if name == method]
        return titles[0] if titles else method

    def prepared(self, molecule, quantity):
        """Of the initial mesh without its cavities: what every method was given."""
        given = [number(self.record(molecule, method), "metrics", "before", quantity) for method in self.methods if method != "initial"]
        return next((value for value in given if value is not None), None)
