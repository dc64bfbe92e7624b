# Shows matrices and vectors of Eigen as their numbers in gdb: `print q` says "Eigen 3 x 1: 0 0.5 1".
import gdb

MOST = 200  # numbers that are shown


class MatrixPrinter:
    def __init__(self, value):
        self.value = value
        kind = value.type.strip_typedefs()
        self.fixed = [int(kind.template_argument(i)) for i in (1, 2)]
        self.by_rows = int(kind.template_argument(3)) & 1
        self.scalar = kind.template_argument(0)

    def to_string(self):
        storage = self.value["m_storage"]
        sizes = [int(storage[name]) if known < 0 else known
                 for known, name in zip(self.fixed, ("m_rows", "m_cols"))]
        rows, cols = sizes
        data = storage["m_data"]
        if data.type.code != gdb.TYPE_CODE_PTR:
            data = data["array"]
        data = data.cast(self.scalar.pointer()) if data.type.code == gdb.TYPE_CODE_PTR else data
        if rows < 0 or cols < 0 or rows * cols > 10**6:
            return f"Eigen matrix that was never set ({rows} x {cols})"
        shown = []
        for i in range(rows):
            line = [f"{float(data[i * cols + j if self.by_rows else i + j * rows]):.6g}" for j in range(cols)]
            shown.append(" ".join(line))
            if (i + 1) * cols > MOST:
                shown.append("...")
                break
        separator = " " if cols == 1 else "\n  "
        start = "" if cols == 1 or rows == 1 else "\n  "
        return f"Eigen {rows} x {cols}: {start}{separator.join(shown)}"


def lookup(value):
    kind = value.type.strip_typedefs()
    if kind.code == gdb.TYPE_CODE_REF:
        kind = kind.target().strip_typedefs()
        value = value.referenced_value()
    name = kind.unqualified().tag or ""
    return MatrixPrinter(value) if name.startswith(("Eigen::Matrix<", "Eigen::Array<")) else None


gdb.pretty_printers.append(lookup)
