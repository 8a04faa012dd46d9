// SPDX-License-Identifier: BSL-1.0
// Scene files that mean harm, and includes.
#include "catch.hpp"
#include "io/files.hpp"

#include <sinew/runtime/xml_document.hpp>

using namespace sinew;

namespace {
std::string wrong(std::string content) {
  try {
    XmlReader().parse("hostile.scn", std::move(content));
  } catch (Error const& error) {
    return error.what();
  }
  return "nothing was wrong";
}
std::string repeated(std::string_view part, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) all += part;
  return all;
}
}  // namespace

TEST_CASE("elements know their place") {
  const XmlElement root = XmlReader().parse("a.scn", "<Node>\n  <A x='1'\n     y='2'/>\n</Node>");
  CHECK(root.place() == "a.scn:1:1");
  REQUIRE(root.children.size() == 1);
  CHECK(root.children[0].place() == "a.scn:2:3");
  CHECK(root.children[0].place(*root.children[0].attribute("y")) == "a.scn:3:6");
}

TEST_CASE("hostile files end in a sentence") {
  CHECK_THAT(wrong(repeated("<Node>", 100000) + repeated("</Node>", 100000)),
             Catch::Contains("nested more than 200 deep"));
  CHECK_THAT(wrong("<Node>" + repeated("<A/>", 1000001) + "</Node>"),
             Catch::Contains("one element too many"));
  CHECK_THAT(wrong("<Node>\xff\xfe</Node>"), Catch::Contains("hostile.scn:1:7: is no UTF-8 text"));
  CHECK_THAT(wrong(std::string("<Node>\0</Node>", 14)), Catch::Contains("is no UTF-8 text"));
  CHECK_THAT(wrong("\xed\xa0"), Catch::Contains("is no UTF-8 text"));
  CHECK_THAT(wrong("<Node a='" + std::string(1000000, '<')), Catch::Contains("is no well-formed XML"));
  CHECK_THAT(wrong("<!-- only a comment -->"), Catch::Contains("No document element"));
}

TEST_CASE("entities are not expanded") {
  const XmlElement root =
      XmlReader().parse("billion.scn", R"(<!DOCTYPE x [<!ENTITY a "aaaaaaaaaa"><!ENTITY b "&a;&a;&a;">]>
<Node name="&b;"/>)");
  CHECK(root.attribute("name")->value == "&b;");
}

TEST_CASE("a file includes others, never itself") {
  const files::TempFolder folder;
  folder.write("part.xml", "<Node name='part'><A/></Node>");
  folder.write("group.xml", "<Group><B/><C/></Group>");
  folder.write("circle.scn", "<Node><include href='circle.scn'/></Node>");
  folder.write("far.scn", "<Node><include href='near.scn'/></Node>");
  folder.write("near.scn", "<Node><include href='far.scn'/></Node>");
  const std::string main = folder.write(
      "main.scn", "<Node><include href='part.xml' name='other'/><include href='group.xml'/></Node>");
  const XmlElement root = XmlReader().read(main);
  REQUIRE(root.children.size() == 3);
  CHECK(root.children[0].attribute("name")->value == "other");
  CHECK(root.children[2].tag == "C");
  CHECK_THROWS_WITH(XmlReader().read(folder / "circle.scn"), Catch::Contains("includes itself"));
  CHECK_THROWS_WITH(XmlReader().read(folder / "far.scn"), Catch::Contains("includes itself"));
  CHECK_THROWS_WITH(XmlReader().parse("x.scn", "<Node><include href='nothing.xml'/></Node>"),
                    Catch::Contains("x.scn:1:7: <include>: there is no file 'nothing.xml'"));
  CHECK_THROWS_WITH(XmlReader().parse("x.scn", "<Node><include/></Node>"), Catch::Contains("has no href"));
}

TEST_CASE("files are looked for beside the scene, then below the data paths") {
  const files::TempFolder folder;
  folder.write("mesh.obj", "v 0 0 0\n");
  CHECK(XmlReader({folder / ""}).find("mesh.obj", "/nowhere/") == folder / "mesh.obj");
  CHECK_THROWS_WITH(XmlReader({"/data"}).find("mesh.obj", "/nowhere/"),
                    Catch::Contains("in /nowhere/, /data"));
}
