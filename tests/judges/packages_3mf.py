"""3MF packages that readers must refuse or accept, of the kinds in the 3MF consortium's test suite:
a package of one tetrahedron, with one change each."""
import io
import struct
import zipfile

CORE = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
MODEL_TYPE = "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"
MESH = ('<mesh><vertices><vertex x="0" y="0" z="0"/><vertex x="10" y="0" z="0"/>'
        '<vertex x="0" y="10" z="0"/><vertex x="0" y="0" z="10"/></vertices><triangles>'
        '<triangle v1="0" v2="2" v3="1"/><triangle v1="0" v2="1" v3="3"/>'
        '<triangle v1="1" v2="2" v3="3"/><triangle v1="0" v2="3" v3="2"/></triangles></mesh>')
OBJECT = f'<object id="1" type="model">{MESH}</object>'
BUILD = '<build><item objectid="1"/></build>'
MODEL = (f'<?xml version="1.0" encoding="UTF-8"?>\n<model unit="millimeter" xml:lang="en-US" '
         f'xmlns="{CORE}"><resources>{OBJECT}</resources>{BUILD}</model>')
TYPES = ('<?xml version="1.0" encoding="UTF-8"?>\n'
         '<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types"><Default '
         'Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>'
         '<Default Extension="model" '
         'ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/></Types>')
RELATIONS = ('<?xml version="1.0" encoding="UTF-8"?>\n'
             '<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">'
             f'<Relationship Id="r" Target="/3D/3dmodel.model" Type="{MODEL_TYPE}"/></Relationships>')


def package(model=MODEL, relations=RELATIONS, types=TYPES):
    data = io.BytesIO()
    with zipfile.ZipFile(data, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, text in (("[Content_Types].xml", types), ("_rels/.rels", relations),
                           ("3D/3dmodel.model", model)):
            if text is not None:
                archive.writestr(name, text)
    return data.getvalue()


def changed(old, new):
    assert MODEL.count(old) >= 1, old
    return package(MODEL.replace(old, new, 1))


def encrypted():
    """The flag of encryption is set for every part."""
    data = bytearray(package())
    for signature, flags in ((b"PK\3\4", 6), (b"PK\1\2", 8)):
        at = data.find(signature)
        while at >= 0:
            bits, = struct.unpack_from("<H", data, at + flags)
            struct.pack_into("<H", data, at + flags, bits | 1)
            at = data.find(signature, at + 4)
    return bytes(data)


def components(ids, parts):
    """Objects made of objects: `parts(id)` are the ids of which an object is made."""
    return "".join(f'<object id="{i}" type="model"><components>'
                   + "".join(f'<component objectid="{p}"/>' for p in parts(i))
                   + "</components></object>" for i in ids)


def with_objects(before, after, built):
    return package(MODEL.replace(OBJECT, before + OBJECT + after).replace(
        BUILD, f'<build><item objectid="{built}"/></build>'))


def must_fail():
    entity = "".join(f'<!ENTITY e{i} "{("&e%d;" % (i - 1)) * 10}">' for i in range(1, 10))
    return {
        "unknown unit": changed("millimeter", "league"),
        "missing vertices": changed(MESH[:MESH.index("<triangles>")], "<mesh><vertices></vertices>"),
        "missing triangles": changed(MESH[MESH.index("<triangles>"):],
                                     "<triangles></triangles></mesh>"),
        "index out of range": changed('v3="3"', 'v3="4"'),
        "negative index": changed('v3="3"', 'v3="-1"'),
        "a triangle without a corner": changed(' v3="3"', ""),
        "degenerate triangle": changed('v1="0" v2="2" v3="1"', 'v1="0" v2="2" v3="2"'),
        "a coordinate with a comma": changed('x="10"', 'x="1,5"'),
        "a coordinate that is no number": changed('x="10"', 'x="abc"'),
        "infinite coordinate": changed('x="10"', 'x="INF"'),
        "duplicate ids": with_objects("", OBJECT, 1),
        "id 0": changed('id="1"', 'id="0"'),
        "an item of no object": changed('objectid="1"', 'objectid="7"'),
        "a property group that is not there": changed('id="1" ', 'id="1" pid="9" pindex="0" '),
        "forward reference": with_objects(components([2], lambda i: [1]), "", 2),
        "an object of itself": with_objects("", components([2], lambda i: [2]), 2),
        "a cycle of components": with_objects("", components([2, 3], lambda i: [5 - i]), 3),
        "component bomb": with_objects("", components(range(2, 40), lambda i: [i - 1] * 2), 39),
        "deep components": with_objects("", components(range(2, 200), lambda i: [i - 1]), 199),
        "mesh and components": changed("</mesh>", '</mesh><components/>'),
        "singular transform": changed('objectid="1"',
                                      'objectid="1" transform="1 0 0 0 1 0 0 0 0 0 0 0"'),
        "transform of 11 numbers": changed('objectid="1"',
                                           'objectid="1" transform="1 0 0 0 1 0 0 0 1 0 0"'),
        "no build": changed(BUILD, ""),
        "an element that the core does not know": changed("<resources>", "<unknown/><resources>"),
        "an unknown required extension": changed(
            "<model ", '<model xmlns:q="urn:q" requiredextensions="q" '),
        "document type": changed("<model ", "<!DOCTYPE model><model "),
        "entities": changed("<model ", f'<!DOCTYPE model [<!ENTITY e0 "x">{entity}]><model '),
        "unfinished XML": package(MODEL[:-30]),
        "zip bomb": package(MODEL + " " * (256 << 20)),
        "encrypted parts": encrypted(),
        "no model part": package(model=None),
        "no relationships": package(relations=None),
        "a relationship of another type": package(relations=RELATIONS.replace("3dmodel\"", "x\"")),
        "two models": package(relations=RELATIONS.replace(
            "</Rel", f'<Relationship Id="s" Target="/3D/2.model" Type="{MODEL_TYPE}"/></Rel')),
        "no content type": package(types=TYPES.replace('"model"', '"other"')),
        "a zip that ends early": package()[:-40],
    }


def must_pass():
    return {
        "tetrahedron": package(),
        "inches": changed("millimeter", "inch"),
        "without a unit": changed('unit="millimeter" ', ""),
        "an item with a transform": changed(
            'objectid="1"', 'objectid="1" transform="1 0 0 0 1 0 0 0 1 5 5 5"'),
        "components": with_objects("", components([2, 3], lambda i: [i - 1]), 3),
        "metadata": changed("<resources>", '<metadata name="Title">t</metadata><resources>'),
        "base materials": changed("<resources>", '<resources><basematerials id="5"><base name="a" '
                                  'displaycolor="#FF0000"/></basematerials>'),
        "an unknown namespace": changed("<model ", '<model xmlns:q="urn:q" q:a="1" '),
        "exponents": changed('x="10"', 'x="1.0e1"'),
    }
