# SPDX-License-Identifier: Apache-2.0
"""What programs write into every file, and what no picture needs, gives no warning."""

HOUDINI = """
def HoudiniLayerInfo "HoudiniLayerInfo" (customData = { string HoudiniCreatorNode = "/stage/sopimport1" }) {}
def Xform "geo" (customData = { int HoudiniPrimEditorNodeId = 12 }
    kind = "component")
{
    bool primvars:karma:object:causticsenable = 1 (interpolation = "constant")
    string primvars:karma:object:rendervisibility = "*" (interpolation = "constant")
    int primvars:karma:object:diffuselimit = 1
    int[] primvars:arnold:visibility = [255] (interpolation = "constant")
    bool[] primvars:arnold:visibility:specular_transmit = [0]
    bool[] primvars:arnold:visibility:diffuse_transmit = [0]
    bool primvars:arnold:visibility:subsurface = 0
    bool primvars:arnold:opaque = 0
    token primvars:arnold:subdiv_type = "none"
    int primvars:ri:attributes:identifier:id = 3
    string[] primvars:varmap = ["a -> b", "c -> d"] (interpolation = "constant")
    float[] primvars:detail = [1, 2, 3] (interpolation = "constant")
    def Mesh "mesh"
    {
        float[] primvars:houdini:pscale = [1, 1, 1, 1] (interpolation = "vertex")
        string[] primvars:name = ["piece0"] (interpolation = "uniform")
        int[] primvars:name:indices = [0]
        custom token userProperties:kind = "prop"
        custom rel material:binding:preview_copy
        int[] faceVertexCounts = [4]
        int[] faceVertexIndices = [0, 1, 2, 3]
        point3f[] points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
    }
}
def Camera "camera"
{
    custom string houdini:guidescale = "1"
    float[] primvars:arnold:fov = [45] (interpolation = "constant")
    float primvars:arnold:exposure = 0
    string primvars:arnold:camera = "persp_camera"
    token karma:camera:lensshader = ""
    float ri:projection:fov = 45
}
"""

MAYA_BLENDER_OMNIVERSE = """
def Xform "root" (customData = { dictionary Blender = { bool generated = 1 } }
    kind = "assembly")
{
    custom string userProperties:blender:object_name = "Cube"
    custom bool userProperties:visible = 1
    custom string omni:kit:property = "x"
    bool primvars:doNotCastShadows = 0
    token[] primvars:omni:tags = ["a", "b"]
    bool primvars:hideForCamera = 0
    bool primvars:invisibleToSecondaryRays = 0
    uniform token purpose = "default"
    def Scope "Looks"
    {
        def Material "physics" (prepend apiSchemas = ["PhysicsMaterialAPI"])
        {
            float physics:staticFriction = 0.5
        }
    }
    def Mesh "Cube" (prepend apiSchemas = ["MaterialBindingAPI", "PhysicsCollisionAPI", "PhysicsMeshCollisionAPI"])
    {
        rel material:binding:physics = </root/Looks/physics> (bindMaterialAs = "weakerThanDescendants")
        uniform bool primvars:polyflag = 1
        int[] primvars:maya:holes = [] (interpolation = "uniform")
        color3f[] primvars:colorSet1 = [(1, 1, 1)] (
            customData = { bool Authored = 1 }
            interpolation = "constant")
        int[] faceVertexCounts = [4]
        int[] faceVertexIndices = [0, 1, 2, 3]
        point3f[] points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
    }
    def DomeLight_1 "dome"
    {
        token light:shaderId = "DomeLight"
        bool inputs:visibleInPrimaryRay = 1
        custom bool omni:rtx:skip = 0
    }
    def SphereLight "lamp" (prepend apiSchemas = ["ShapingAPI"])
    {
        token light:shaderId = "SphereLight"
        token karma:light:contribs = ""
        bool primvars:arnold:cast_volumetric_shadows = 1
        int[] primvars:arnold:samples = [2]
    }
}
def PhysicsScene "physics" {}
def OmniGraph "graph" { def OmniGraphNode "node" {} }
def Scope "OmniverseKit_Viewport" {}
def RenderSettings "settings" { custom int karma:global:samples = 4 }
def Xform "bones" { def Skeleton "loose" {} }
"""


def test_houdini_and_its_renderers(read):
    assert read(HOUDINI).warnings == []


def test_maya_blender_and_omniverse(read):
    assert read(MAYA_BLENDER_OMNIVERSE).warnings == []
