# SPDX-License-Identifier: Apache-2.0
"""Materials that mean harm, or too much: the page stays safe and opens, or there is a clear refusal."""
import base64
import hashlib
import json
import re

import numpy as np
import pytest

import mtlx

EVIL = "PATINA_SCRIPT &lt;/script&gt;&lt;img src=x onerror=alert(1)&gt;&quot;];alert(2);//*/ }"


def matte(name, color, nodes=None, node="b"):
    """:returns: a document of a matte material"""
    return mtlx.document(nodes or {}, mtlx.lobe(name, "oren_nayar_diffuse_bsdf", {"color": color}, node=node))


def green(name):
    """Its lobe has nearly that name, too."""
    return matte(name + " 2", (0.1, 0.7, 0.2), node=name)


def middle(picture):
    h, w = picture.shape[:2]
    return picture[h * 3 // 8:h * 5 // 8, w * 3 // 8:w * 5 // 8].mean(axis=(0, 1))


def shown(chromium, page):
    chromium.open(page, "?width=48")
    picture = chromium.picture("page.state.samples = 8; page.state.environment = "
                               "page.data.environments.findIndex(e => e.name === 'even')")
    assert chromium.messages() == []
    return middle(picture)


def test_script_in_names_stays_text(make, chromium, tmp_path):
    file = tmp_path / "evil.mtlx"
    file.write_text(green(EVIL))
    controls = tmp_path / "controls.json"
    evil = "PATINA_SCRIPT PATINA_DATA </script><script>alert(3)</script><!--"
    controls.write_text(json.dumps({"title": evil, "presets": [{"name": evil, "values": {}}]}))
    page = make("evil.html", file, "--title", evil, "--controls", controls)
    text = open(page, encoding="utf-8").read()
    assert text.count("</script") == 2 and "onerror=alert" not in text.replace("\\u003c", "<").split("patina-data")[0]
    color = shown(chromium, page)
    assert color[1] > 2.0 * color[0]
    assert chromium.evaluate("return [document.images.length, document.title.length > 5]") == [0, True]
    layer = chromium.evaluate("""const name = page.data.materials[0].layer.defaultPrim; return name;""")
    assert layer.replace("_", "a").isalnum()


# The first line ends the driver's own task, in which the browser lets text become code.
RUNS = """await new Promise(resolve => setTimeout(resolve, 0));
window.owned = [];
const script = document.createElement("script");
script.textContent = "owned.push('script')";
document.body.append(script);
const holder = document.createElement("div");
holder.innerHTML = "<img src='data:,' onerror=\\"owned.push('handler')\\">";
document.body.append(holder);
const link = document.createElement("a");
link.href = "javascript:owned.push('link')";
document.body.append(link);
link.click();
for (const use of [() => fetch("https://example.org/"), () => Function("owned.push('text')")()]) {
    try { await use(); owned.push("allowed"); } catch (error) {}
}
await new Promise(resolve => setTimeout(resolve, 200));
return owned;"""


def policy_of(page):
    """:returns: the rules of a page's policy, where it stands before all that it is for"""
    text = open(page, encoding="utf-8").read()
    head = text.partition("</head>")[0]
    content = re.search(r'<meta http-equiv="Content-Security-Policy" content="([^"]*)">', head)
    assert content and not re.search("<(script|style|link|title)", head[:content.start()])
    return {rule.split()[0]: rule.split()[1:] for rule in content.group(1).split(";")}, text


def test_the_page_runs_its_own_script_alone(make, chromium, tmp_path):
    """Should a name ever reach the page as markup, it runs nothing and sends nothing."""
    (tmp_path / "evil.mtlx").write_text(green(EVIL))
    page = make("policy.html", tmp_path / "evil.mtlx")
    rules, text = policy_of(page)
    script = re.search(r"<script>(.*?)</script>", text, re.DOTALL).group(1)
    digest = base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()
    assert rules["script-src"] == [f"'sha256-{digest}'"] and rules["default-src"] == ["'none'"]
    chromium.open(page, "?width=32")
    assert chromium.evaluate(RUNS) == []
    refused = [line for line in chromium.messages() if "Content Security Policy" in line]
    assert len(refused) >= 4  # script, handler, link, request: told by the browser


def many(file, count, varies):
    """A tree of `count` sums of two inputs each; where it varies, nothing of it can be done beforehand."""
    nodes = {"p": ("position vector3", {}), "c": ("convert color3", {"in": "<p>"})}
    for i in range(count):
        parts = [f"<n{k}>" if k < count else "<c>" if varies and k % 2 else f"{0.001 + k * 1e-8:.8f}, 0.0005, 0.0005"
                 for k in (2 * i + 1, 2 * i + 2)]
        nodes[f"n{i}"] = ("add color3", {"color3 in1": parts[0], "color3 in2": parts[1]})
    file.write_text(matte("many", "<n0>", nodes))


@pytest.mark.parametrize("count_of_inputs", [2400, 10000])
def test_thousands_of_inputs(count_of_inputs, make, chromium, tmp_path):
    many(tmp_path / "many.mtlx", count_of_inputs // 2, False)
    color = shown(chromium, make("many.html", tmp_path / "many.mtlx"))
    assert color[0] > 1.5 * color[1] > 0.0
    count, note = chromium.evaluate("return [page.data.materials[0].inputs.length, page.state.current.notes.join()]")
    assert count == 1024 and "more inputs have no slider" in note
    chromium.evaluate("page.panel.gui.foldersRecursive().forEach(f => f.open().fill?.())")
    assert chromium.evaluate("return page.panel.gui.controllersRecursive().length") > 1030
    assert chromium.messages() == []


def test_a_shader_that_no_browser_takes_is_refused(tmp_path, capsys):
    from patina.cli import main

    many(tmp_path / "many.mtlx", 4000, True)
    assert main.main(["view", str(tmp_path / "many.mtlx"), "-o", str(tmp_path / "x.html")]) == 1
    error = capsys.readouterr().err
    assert "too large for a page" in error and error.count("\n") == 1


def test_a_huge_texture_is_made_smaller(make, chromium, tmp_path):
    import _patina

    wide = np.zeros((64, 8192, 3), np.float32)
    wide[...] = (0.6, 0.05, 0.05)
    _patina.write_image(str(tmp_path / "wide.exr"), wide)
    file = tmp_path / "textured.mtlx"
    file.write_text(matte("textured", "<picture>", {"picture": ("image color3", {"filename file": "wide.exr"})}))
    page = make("textured.html", file, "--textureSize", 256)
    color = shown(chromium, page)
    assert color[0] > 3.0 * color[1]
    width, note = chromium.evaluate("return [page.data.textures[0].width, page.state.current.notes.join()]")
    assert width <= 256 and "8192" in note


@pytest.mark.parametrize("text, reason", [
    ("{", "is no JSON"), ("[]", "needs lists"), ('{"controls": [1]}', "needs a text `input`"),
    ('{"presets": [{"name": 1}]}', "each preset"), ('{"sentences": 3}', "holds texts"),
    ('{"controls": [{"input": "/plain.color", "min": %s}]}' % ("9" * 5000), "is no JSON"),
    ('{"controls": [{"input": "/plain.color", "min": %s}]}' % ("9" * 400), "`min` of /plain.color"),
    ('{"controls": [{"input": "/plain.color", "max": 1e999}]}', "`max` of /plain.color"),
    ('{"presets": [{"name": "a", "values": {"/plain.color": [0, 0, %s]}}]}' % ("9" * 400), "/plain.color needs a list"),
    ('{"controls": [{"input": "/plain.color", "kind": "switch"}]}', "`kind` of /plain.color does not fit"),
    ('{"controls": [{"input": "/plain.roughness", "kind": "color"}]}', "`kind` of /plain.roughness does not fit"),
    ('{"controls": [{"input": "/plain.color"}, {"input": "/plain.color", "label": "again"}]}', "has /plain.color twice"),
    ('{"controls": [{"input": "none.x"}, {"input": "none.x"}]}', "has none.x twice"),
    ('{"presets": [%s]}' % ", ".join(['{"name": "a", "values": {}}'] * 1001), "more than the 1000")])
def test_bad_controls_are_refused(tmp_path, capsys, text, reason):
    from patina.cli import main

    file, controls = tmp_path / "plain.mtlx", tmp_path / "controls.json"
    file.write_text(green("plain"))
    controls.write_text(text)
    assert main.main(["view", str(file), "--controls", str(controls), "-o", str(tmp_path / "x.html")]) == 1
    error = capsys.readouterr().err
    assert reason in error and error.count("\n") == 1
    assert not (tmp_path / "x.html").exists()
