"""The CSV tables of a result folder."""
import csv


def read_table(file):
    """Column name -> numbers."""
    with open(file) as stream:
        rows = list(csv.reader(line for line in stream if not line.startswith("#")))
    return {name: [float(row[k] or "nan") for row in rows[1:]] for k, name in enumerate(rows[0])}


def row_borders(depth):
    """Borders of a section's rows from their centres: the first begins at the surface."""
    borders = [0.0]
    for centre in depth:
        borders.append(2 * centre - borders[-1])
    return borders
