#!/usr/bin/env python3
"""lib3mf_volume.py FILE: reads a 3MF in the strict mode of lib3mf 1.8 and prints the volume of its
meshes [mm3]. Exit status 1 if lib3mf refuses the file or warns of it."""
import ctypes
import sys

lib = ctypes.CDLL("lib3MF.so.1")


class Vertex(ctypes.Structure):
    _fields_ = [("at", ctypes.c_float * 3)]


class Triangle(ctypes.Structure):
    _fields_ = [("corners", ctypes.c_uint32 * 3)]


def call(name, *arguments):
    code = getattr(lib, "lib3mf_" + name)(*arguments) & 0xFFFFFFFF
    if code != 0:
        print(f"{name}: 0x{code:x}", file=sys.stderr)
        sys.exit(1)


def number_from(name, thing, kind=ctypes.c_uint32):
    value = kind()
    call(name, thing, ctypes.byref(value))
    return value.value


def volume_of(mesh):
    points = []
    for i in range(number_from("meshobject_getvertexcount", mesh)):
        vertex = Vertex()
        call("meshobject_getvertex", mesh, ctypes.c_uint32(i), ctypes.byref(vertex))
        points.append(tuple(vertex.at))
    total = 0.0
    for i in range(number_from("meshobject_gettrianglecount", mesh)):
        triangle = Triangle()
        call("meshobject_gettriangle", mesh, ctypes.c_uint32(i), ctypes.byref(triangle))
        (a, b, c), (d, e, f), (g, h, k) = (points[p] for p in triangle.corners)
        total += a * (e * k - f * h) - b * (d * k - f * g) + c * (d * h - e * g)
    return total / 6.0


def main():
    model, reader, meshes = ctypes.c_void_p(), ctypes.c_void_p(), ctypes.c_void_p()
    call("createmodel", ctypes.byref(model))
    call("model_queryreader", model, b"3mf", ctypes.byref(reader))
    call("reader_setstrictmodeactive", reader, ctypes.c_int(1))
    call("reader_readfromfileutf8", reader, sys.argv[1].encode())
    warnings = number_from("reader_getwarningcount", reader)
    if warnings:
        sys.exit(f"{warnings} warnings")
    call("model_getmeshobjects", model, ctypes.byref(meshes))
    total = 0.0
    while number_from("resourceiterator_movenext", meshes, ctypes.c_int):
        mesh = ctypes.c_void_p()
        call("resourceiterator_getcurrent", meshes, ctypes.byref(mesh))
        if not number_from("meshobject_ismanifoldandoriented", mesh, ctypes.c_int):
            sys.exit("a mesh is no oriented manifold")
        total += volume_of(mesh)
    print(total)


main()
