"""Prints the curves that Alembic's own library finds in archives. Usage: load_alembic.py FILE...

Prints float32 as the eight hexadecimal digits of the bits, and integers as decimals. Needs the
environment of scripts/setup --alembic.
"""

import struct
import sys

from alembic3d import Abc, AbcGeom


def words(values):
    """Returns floats and vectors of them as their bits, and other values as they are."""
    for value in values:
        if isinstance(value, int):
            yield str(value)
            continue
        numbers = [value] if isinstance(value, float) else [value[i] for i in range(len(value))]
        for number in numbers:
            yield struct.pack(">f", number).hex()


def show(name, values):
    print(name, *words(values))


def show_parameters(compound):
    for i in range(compound.getNumProperties()):
        header = compound.getPropertyHeader(i)
        scope = header.getMetaData().get("geoScope")
        values = Abc.IArrayProperty(compound, header.getName()).getValue()
        show(f"{header.getName()} {header.getDataType()} {scope}", values)


def visit(item):
    header = item.getHeader()
    if AbcGeom.IXform.matches(header):
        schema = AbcGeom.IXform(item.getParent(), item.getName()).getSchema()
        print("transform", item.getFullName(), schema.getValue().getMatrix())
        show_parameters(schema.getArbGeomParams())
    if AbcGeom.ICurves.matches(header):
        schema = AbcGeom.ICurves(item.getParent(), item.getName()).getSchema()
        for i in range(schema.getNumSamples()):
            curves = schema.getValue(Abc.ISampleSelector(i))
            if i == 0:
                print("curves", item.getFullName(), curves.getType(), curves.getWrap(),
                      curves.getBasis())
            else:
                print("at", schema.getTimeSampling().getSampleTime(i))
            show("P", curves.getPositions())
            show("nVertices", curves.getCurvesNumVertices())
            show("bounds", [*map(float, curves.getSelfBounds().min())] +
                 [*map(float, curves.getSelfBounds().max())])
        widths = schema.getWidthsParam()
        if widths:
            show(f"width {widths.getScope()}", widths.getExpandedValue().getVals())
        show_parameters(schema.getArbGeomParams())
        own = schema.getUserProperties()
        for name in ("hairbench:metersPerUnit", "hairbench:comment"):
            print(name, Abc.IScalarProperty(own, name).getValue())
    for i in range(item.getNumChildren()):
        visit(item.getChild(i))


for path in sys.argv[1:]:
    visit(Abc.IArchive(path).getTop())
