// SPDX-License-Identifier: BSL-1.0
// Scene files that mean harm, and includes.
#include "catch.hpp"
#include "io/files.hpp"

#include <sinew/runtime/xml_document.hpp>

namespace test_xml_document {

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

TEST_CASE("an attribute right behind the quote of another is read, with a warning") {
  XmlReader reader;
  const XmlElement root = reader.parse("a.scn",
                                       "<Node a=\"1\"b='x\"y'c=\"<d='2'e\">\n  <!-- a=\"1\"b=\"2\" -->\n"
                                       "  text \"1\"b\n  <B f='3' g=\"4\"/></Node>");
  REQUIRE(root.attributes.size() == 3);
  CHECK(root.attribute("a")->value == "1");
  CHECK(root.attribute("b")->value == "x\"y");
  CHECK(root.attribute("c")->value == "<d='2'e");
  REQUIRE(root.children.size() == 1);
  CHECK(root.children[0].place() == "a.scn:4:3");
  CHECK(root.children[0].attributes.size() == 2);
  REQUIRE(reader.warnings.size() == 1);
  CHECK_THAT(reader.warnings[0], Catch::Contains("a.scn:1:12: ") && Catch::Contains("blank"));
  for (char const* content :
       {"<Node a=\"1", "<Node a='1'b", "<!-- a='1'b", "<Node a='1'b=", "<", "<![CDATA[", ""})
    CHECK(wrong(content) != "nothing was wrong");
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
  for (char const* name : {"nothing.xml", "/nothing.xml"})
    CHECK_THROWS_WITH(
        XmlReader({}, "drop it along").parse("x.scn", text("<Node><include href='", name, "'/></Node>")),
        Catch::Contains(text("there is no file '", name, "'; drop it along")));
  CHECK_THROWS_WITH(XmlReader().parse("x.scn", "<Node><include/></Node>"), Catch::Contains("has no href"));
}

TEST_CASE("a file of the folder Objects stands for an element that is no class") {
  const files::TempFolder folder;
  std::filesystem::create_directory(folder / "Objects");
  folder.write("Objects/Pair.xml", "<Node name='Group'><A n='1'/><Deep/></Node>");
  folder.write("Objects/Deep.xml", "<Node name='deep'><A n='2'/></Node>");
  folder.write("Objects/Circle.xml", "<Group><Circle/></Group>");
  auto isClass = [](XmlElement const& e) { return e.tag == "Node" || e.tag == "A"; };
  XmlReader reader({folder / ""});
  XmlElement root = reader.parse("x.scn", "<Node><A/><Node><Pair n='7' m='1'/></Node><Other/></Node>");
  reader.expandObjects(root, isClass);
  REQUIRE(root.children.size() == 3);
  CHECK(root.children[2].tag == "Other");  // there is no such file
  auto const& pair = root.children[1].children;
  REQUIRE(pair.size() == 2);
  CHECK(pair[0].attribute("n")->value == "7");
  CHECK(pair[1].attribute("name")->value == "deep");
  CHECK(pair[1].children[0].attribute("n")->value == "7");
  REQUIRE(reader.warnings.size() == 1);
  CHECK_THAT(reader.warnings[0], Catch::Contains("<Pair>: no element of 'Objects/Pair.xml'"));
  XmlElement circle = reader.parse("x.scn", "<Node><Circle/></Node>");
  CHECK_THROWS_WITH(reader.expandObjects(circle, isClass), Catch::Contains("includes itself"));
}

TEST_CASE("the children of an included group stand in the place of the include") {
  const files::TempFolder folder;
  folder.write("a.xml", "<Node name='Group' gravity='0 0 0'><A/><Node/></Node>");
  folder.write("b.xml", "<Node name='_Group_'><B/></Node>");
  folder.write("c.xml", "<Node name='body'><C/></Node>");
  auto read = [&](std::string content) {
    return XmlReader({folder / ""}).parse("main.scn", "<Node>" + std::move(content) + "</Node>").children;
  };
  auto const a = read("<include href='a.xml' name='named'/>");
  REQUIRE(a.size() == 2);
  CHECK(a[0].tag == "A");
  CHECK(read("<include href='b.xml'/>").at(0).tag == "B");
  CHECK(read("<include href='c.xml'/>").at(0).attribute("name")->value == "body");
  CHECK(read("<include href='c.xml' name='Group'/>").at(0).tag == "C");
}

TEST_CASE("attributes of an include replace those that are there") {
  const files::TempFolder folder;
  folder.write("part.xml", R"(<Node name='part' dx='0'>
  <A name='one' dx='0' k='1'/>
  <Node><A name='two' dx='0' k='1'/></Node>
</Node>)");
  XmlReader reader({folder / ""});
  const XmlElement root = reader.parse("main.scn", R"(<Node>
  <include href='part.xml' dx='3' two__k='7' tags='' dy='1' three__k='8'/>
</Node>)");
  auto const& part = root.children.at(0);
  auto const &one = part.children.at(0), &two = part.children.at(1).children.at(0);
  CHECK(part.attribute("dx")->value == "3");
  CHECK(one.attribute("dx")->value == "3");
  CHECK(two.attribute("dx")->value == "3");
  CHECK(one.attribute("k")->value == "1");
  CHECK(two.attribute("k")->value == "7");
  CHECK_FALSE(one.attribute("dy"));
  // what is wrong with such a value is wrong where it stands
  CHECK(one.place(*one.attribute("dx")) == "main.scn:2:28");
  CHECK(one.place(*one.attribute("k")) == folder / "part.xml" + ":2:24");
  REQUIRE(reader.warnings.size() == 2);
  CHECK(reader.warnings[0] ==
        "main.scn:2:54: <include>: no element of 'part.xml' has the attribute 'dy' that "
        "could be replaced; it has no effect");
  CHECK_THAT(reader.warnings[1], Catch::Contains("'three__k'"));
}

TEST_CASE("an included element that is named _Merge_ is merged into the one around") {
  const files::TempFolder folder;
  folder.write("more.xml", R"(<Node name='_Merge_' gravity='0 0 0'>
  <A name='a' k='2' m='3'/> <A name='b'/> <A/> <Node name='n'><B/></Node>
</Node>)");
  const XmlElement root = XmlReader({folder / ""}).parse("main.scn", R"(<Node name='root' gravity='1 1 1'>
  <A name='a' k='1'/> <B name='b'/> <Node name='n'><C/></Node> <include href='more.xml'/>
</Node>)");
  CHECK(root.attribute("name")->value == "root");
  CHECK(root.attribute("gravity")->value == "0 0 0");
  CHECK(root.place(*root.attribute("gravity")) == folder / "more.xml" + ":1:22");
  REQUIRE(root.children.size() == 5);
  CHECK(root.children[0].attribute("k")->value == "2");
  CHECK(root.children[0].attribute("m")->value == "3");
  CHECK(root.children[2].children.at(1).tag == "B");
  CHECK(root.children[3].attribute("name")->value == "b");
  CHECK(root.children[3].tag == "A");
}

TEST_CASE("attributes may be written as elements") {
  const XmlElement root = XmlReader().parse(
      "a.scn", "<Node><A x='1'>\n  <Attribute type='v'><Data value='0 1'/></Attribute></A></Node>");
  auto const& a = root.children.at(0);
  CHECK(a.children.empty());
  REQUIRE(a.attribute("v"));
  CHECK(a.attribute("v")->value == "0 1");
  CHECK(a.place(*a.attribute("v")) == "a.scn:2:29");
  CHECK_THAT(wrong("<A><Attribute><Data value='1'/></Attribute></A>"),
             Catch::Contains("hostile.scn:1:4: <Attribute>: has no type"));
  for (auto* value : {"", "1", "<Data/>", "<Value value='1'/>", "<Data value='1'/><Data value='2'/>"})
    CHECK_THAT(wrong(text("<A><Attribute type='x'>", value, "</Attribute></A>")),
               Catch::Contains("<Data value="));
}

TEST_CASE("of an attribute that is given twice the last counts, and that is said") {
  for (std::string content :
       {"<Node>\n <A k='1' k='2'/></Node>",
        "<Node><A k='1'>\n   <Attribute type='k'><Data value='2'/></Attribute></A></Node>"}) {
    XmlReader reader;
    const XmlElement root = reader.parse("a.scn", content);
    REQUIRE(root.children.at(0).attributes.size() == 1);
    CHECK(root.children.at(0).attributes[0].value == "2");
    REQUIRE(reader.warnings.size() == 1);
    CHECK_THAT(reader.warnings[0],
               Catch::StartsWith("a.scn:2:") &&
                   Catch::Contains(": <A>: attribute 'k' is given twice; the last counts"));
  }
  std::string many = "<A";
  for (int i = 0; i <= 1000; ++i) many += text(" a", i, "='1'");
  CHECK_THAT(wrong(many + "/>"), Catch::Contains("is one attribute too many; an element may have 1000"));
}

TEST_CASE("files are looked for beside the scene, then below the data paths") {
  const files::TempFolder folder;
  folder.write("mesh.obj", "v 0 0 0\n");
  CHECK(XmlReader({folder / ""}).find("mesh.obj", "/nowhere/") == folder / "mesh.obj");
  CHECK_THROWS_WITH(XmlReader({"/data"}).find("mesh.obj", "/nowhere/"),
                    Catch::Contains("in /nowhere/, /data"));
}

}  // namespace test_xml_document
