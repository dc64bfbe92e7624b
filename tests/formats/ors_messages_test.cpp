// What is said about broken scenes: each row is a valid scene with one typo.
#include <gtest/gtest.h>

#include "formats/ors_reader.h"
#include "scene/model.h"

namespace rex::ors_messages_test {

using std::string_view_literals::operator""sv;

// The typo stands between two @, and `right` in its place makes the scene valid. The message is about the
// place of the typo, or about the ^ if there is one.
struct Row {
  std::string_view text, right, message;
};

std::string without(std::string_view marks, std::string text) {
  std::erase_if(text, [&](char c) { return marks.find(c) != std::string_view::npos; });
  return text;
}

std::string withTypo(const Row& row) { return without("^@", std::string(row.text)); }

std::string corrected(const Row& row) {
  std::string text(row.text);
  const std::size_t start = text.find('@'), end = text.find('@', start + 1);
  text.replace(start, end - start + 1, row.right);
  return without("^", text);
}

// "f:line:column: message".
std::string expected(const Row& row) {
  const std::size_t mark = row.text.find('^');
  const std::string_view before =
      row.text.substr(0, mark == std::string_view::npos ? row.text.find('@') : mark);
  const auto line = std::count(before.begin(), before.end(), '\n') + 1;
  const std::string last = without("^@", std::string(before.substr(before.rfind('\n') + 1)));
  return "f:" + std::to_string(line) + ":" + std::to_string(last.size() + 1) + ": " +
         std::string(row.message);
}

std::string errorOf(const std::string& text) {
  try {
    static_cast<void>(compile(parseOrs(text, "f").spec));
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

constexpr Row kErrors[] = {
    // what is not an .ors file
    {"@\xff\xfe@body a {}", "", "text in UTF-16: wanted UTF-8"},
    {"bo@\0@dy a {}"sv, "", "a zero byte, as in UTF-16 text: found '\\x00', wanted UTF-8"},
    {"@\0@b\0o\0d\0y\0"sv, "body b #", "a zero byte, as in UTF-16 text: found '\\x00', wanted UTF-8"},
    {"body a { mass=@x^\0y@ }"sv, "1", "a zero byte, as in UTF-16 text: found '\\x00', wanted UTF-8"},
    {"body a@\x07@ {}", "", "a control character: found '\\x07', wanted text"},
    {"# Gr\xfc\xdf\x65\nbody a@\xe4@b {}", "\xc3\xa4",
     "a byte that is not UTF-8: found '\\xe4', wanted text in UTF-8; only comments may have other bytes"},
    {"body a { type=3 mesh='\na@\xe4@b' }", "",
     "a byte that is not UTF-8: found '\\xe4', wanted text in UTF-8; only comments may have other bytes"},
    {"body a { mass=@\xe4\xc3\xa4@ }", "1",
     "syntax error: found '\\xe4\xc3\xa4', wanted a value: a number, word, \"text\", [array], <T pose> or "
     "{attributes}"},
    {"@<robot name='r'/>@", "body a {}", "this is XML: wanted .ors; if it is a robot in URDF, name it .urdf"},
    {"@//@ an arm\nbody a {}", "#",
     "a comment in the syntax of another language: found '//', wanted '#', which starts a comment"},
    // the grammar
    {"body a { mass=@+-@5 }", "+", "not a number: found '+-5', wanted a number"},
    {"body a { X=<T t(0@,@ 0 1)> }", "",
     "a comma in a pose: found ',', wanted three numbers separated by blanks"},
    {"body a { X=<T @tt@(0 0 1)> }", "t",
     "unknown element of a pose: found 'tt', wanted t(..), d(..), r(..), q(..), E(..), seven numbers, or "
     "'>'"},
    {"body a { mass=0@,@^5 }", ".",
     "body 'a': a number without a name: found '5', wanted '.' as the decimal point, or an attribute "
     "NAME=VALUE"},
    {"body a { mass@ @^1 }", "=", "body 'a': attribute 'mass': '=' is missing: found '1', wanted mass=1"},
    {"body a { type=0 color=^[@255@ 0 0] }", "1",
     "body 'a': attribute 'color': found 255, wanted numbers from 0 to 1"},
    {"body a {}\nbody b {}\njoint j (a b) { type=@prismatic@ }", "transX",
     "joint 'j': unknown type: found 'prismatic', wanted a number from 0 to 14 or a name such as 'hingeX' "
     "(did you mean 'transX'?)"},
    {"body a ^{\n  mass=1 @@", "}", "'{' is never closed: wanted a matching '}' before the end of the file"},
    {"body a { mass=1 }\n@}@", "", "unmatched '}': wanted a body, shape or joint, or the end of the file"},
    {"body a {}\nshape s ^(a@@ {type=0}", ")", "'(' is never closed: wanted a ')' before '{type'"},
    {"body a { mass=@1.2.3@ }", "1.2", "not a number: found '1.2.3', wanted a number"},
    {"body a { mass=@1e999@ }", "1e9", "not a number: found '1e999', wanted a number"},
    {"body a { mass=@-inf@ }", "0", "not a number: found '-inf', wanted a number"},
    {"body a { com=[0 @nan@ 0] }", "0", "not a number: found 'nan', wanted a number or ']'"},
    {"body a { com=[0 @zero@ 0] }", "0", "not a number: found 'zero', wanted a number or ']'"},
    {"body a { com=[0 0 0 @@^}", "] ", "not a number: found '}', wanted a number or ']'"},
    {"body a { com=[0 0 0]\n X=^@[0@", "<T>}", "'[' is never closed: wanted a ']'"},
    {"body a { size=[1 2; 3@@^] }", " 4", "row of an array: found 1 numbers, wanted 2, as in the first row"},
    {"body a { com=^[<@4@> 0 0 0] }", "3", "array with explicit dimensions: found 3 numbers, wanted 1 x 4"},
    {"body a { com=[<1 3@ 1@>^ 0 0 0] }", "", "array dimensions: found 3 of them, wanted one or two"},
    {"body a { com=[<1 @2.5@^> 0 0 0] }", "3", "array dimension: found 2.5, wanted a count"},
    {"body a {}\nbody b {}\nbody c {}\njoint j (a b) { mimic=^\"k@@ }\njoint k (a c) {}", "\"",
     "text is never closed: wanted a second \""},
    {"body a { mesh=^'arm.obj@@ }", "'", "text is never closed: wanted a second '"},
    {"body a { unknown=^<Q 1 2@@ }", ">", "'<' is never closed: wanted a second >"},
    {"body a { X=^<T t(0 0 1)@@", "> }", "'<T' is never closed: wanted a '>'"},
    {"body a { X=<T t(0 0@@^)> }", " 0", "too few numbers in a pose: found ')', wanted three numbers"},
    {"body a { X=<T t(0 0 1 @2@)> }", "", "pose element 't': found '2', wanted ')' after 3 numbers"},
    {"body a { X=<T t^@ @(0 0 1)> }", "", "pose element 't': found ' ', wanted '('"},
    {"body a { X=<T @s@(2 0 0)> }", "t",
     "unknown element of a pose: found 's', wanted t(..), d(..), r(..), q(..), E(..), seven numbers, or '>'"},
    {"body a { X=<T 1 2 3 1 0 0@@^> }", " 0",
     "too few numbers in a pose: found '>', wanted x y z qw qx qy qz"},
    {"body a { X=<T ^q(0 0 0 @0@)> }", "1",
     "quaternion: found (0, 0, 0, 0), wanted a quaternion w x y z that is not zero"},
    {"body a { X=^<T t(1e308 0 0) t(@1e308@ 0 0)> }", "1",
     "pose: found a position beyond the range of numbers, wanted metres"},
    {"body a { mass=@)@ }", "1",
     "syntax error: found ')', wanted a value: a number, word, \"text\", [array], <T pose> or {attributes}"},
    {"body a @)@ {}", "", "syntax error: found ')', wanted a name"},
    {"body a {}\n@;@", "", "syntax error: found ';', wanted a name such as 'body', 'shape' or 'joint'"},
    {"body a { mass=@\x01@ }", "1",
     "syntax error: found '\\x01', wanted a value: a number, word, \"text\", [array], <T pose> or "
     "{attributes}"},
    // statements
    {"@bodi@ a {}", "body",
     "unknown statement: found 'bodi', wanted 'body', 'shape', 'joint', 'pin', 'urdf', 'mjcf' or "
     "'collisions' (did "
     "you mean "
     "'body'?)"},
    {"body a@ @^body b {}", "\n",
     "body 'b': another statement among its words: found 'body', wanted {...} or the end of the line before "
     "it"},
    {"^@body@ { mass=1 }", "body a", "body without a name: wanted 'body NAME { ... }'"},
    {"body a@\n@^{ mass=1 }", "",
     "a value without a name: found {...}, wanted '{' on the line of its body, shape or joint"},
    {"body a = @3@", "{}", "body 'a': found the number 3, wanted {attributes} on the line of its name"},
    {"body a {}\nbody b @(^a)@ {}", "", "body 'b': found parents, wanted none: joints connect bodies"},
    {"@Include=^'arm.ors'@\nbody a {}", "",
     "Include 'arm.ors': found a scene that was given as text, wanted no Include: only scenes in files "
     "include "
     "others"},
    {"ChDir=@parts@\nbody a {}", "'parts'", "ChDir: found 'parts', wanted ChDir='FOLDER'"},
    {"body a {}\n^Delete@@", " a",
     "Delete: found no names, wanted the words of a statement: Delete body NAME"},
    {"body a {}\nDelete a @{}@", "", "Delete: found {...}, wanted only the words of a statement"},
    {"body a {}\n^Edit@@ {}", " body a",
     "Edit: found no names, wanted the words of a statement: Edit body NAME"},
    {"body arm {}\n^Edit body @amr@ { mass=1 }", "arm",
     "nothing to edit: found 'body amr', wanted the words of an earlier statement (did you mean 'body "
     "arm'?)"},
    {"body a { mass=1 }\n^Edit body a @= 3@", "{}",
     "Edit of 'body a': found the number 3, wanted {attributes}"},
    // bodies
    {"body a { mass=@heavy@ }", "1", "body 'a': attribute 'mass': found 'heavy', wanted a number"},
    {"body a { mass=@-1@ }", "1", "body 'a': attribute 'mass': found -1, wanted a mass >= 0 kg"},
    {"body a { X=@[1 2 3]@ }", "<T>", "body 'a': attribute 'X': found an array of 3, wanted a pose <T ...>"},
    {"body a { com=@[1 2]@ }", "[1 2 3]",
     "body 'a': attribute 'com': found an array of 2, wanted an array of 3 numbers"},
    {"body a { com=@[1; 2; 3]@ }", "[1 2 3]",
     "body 'a': attribute 'com': found an array of 3 x 1, wanted an array of 3 numbers"},
    {"body a { com=@[0 inf 0]@ }", "[0 0 0]",
     "body 'a': attribute 'com': found an infinite number, wanted finite numbers"},
    {"body a { mass=1 inertia=@[1 1]@ }", "[1 1 1]",
     "body 'a': attribute 'inertia': found an array of 2, wanted an array of 3 or 6 numbers"},
    {"body a { mass=1 inertia=@[1 1 -1]@ }", "[1 1 1]",
     "body 'a': attribute 'inertia': found a negative principal moment, wanted principal moments >= 0"},
    {"body a { mass=1 inertia=@[1 1 1 2 0 0]@ }", "[1 1 1 .2 0 0]",
     "body 'a': attribute 'inertia': found a negative principal moment, wanted principal moments >= 0"},
    {"body a { dyntype=@5@ }", "2",
     "body 'a': unknown dyntype: found the number 5, wanted a number from 0 to 2 or a name such as "
     "'dynamic'"},
    // shapes
    {"body a { type=@77@ }", "7",
     "body 'a': unknown type: found the number 77, wanted a number from 0 to 11 or a name such as 'ST_box'"},
    {"body a { type=@ST_capsul@ }", "ST_capsule",
     "body 'a': unknown type: found 'ST_capsul', wanted a number from 0 to 11 or a name such as 'ST_box' "
     "(did "
     "you mean 'ST_capsule'?)"},
    {"body a { type=0 size=@[1 2]@ }", "[1 2 3]",
     "body 'a': attribute 'size': found an array of 2, wanted an array of 3 or 4 numbers"},
    {"body a { type=0 size=@[1 2 -3]@ }", "[1 2 3]",
     "body 'a': attribute 'size': found -3, wanted lengths that are not negative"},
    {"body a {\n type=9\n size=^[1 1 1 @.6@] }", ".5",
     "shape 'a': radius of the rounded edges: found 0.6 m, wanted at most half of the shortest edge, 0.5 m"},
    {"body a { type=3 mesh=@arm.obj@ }", "'arm.obj'",
     "body 'a': attribute 'mesh': found 'arm.obj', wanted a file name in single quotes"},
    {"body a { type=3 mesh='a.obj' meshscale=@[1 2]@ }", "[1 2 3]",
     "body 'a': attribute 'meshscale': found an array of 2, wanted a number or an array of 3 numbers"},
    {"body arm {}\nshape (@amr@) { type=0 }", "arm",
     "shape: unknown parent: found 'amr', wanted the name of an earlier body (did you mean 'arm'?)"},
    {"body a {}\nshape (@wrld@) { type=0 }", "world",
     "shape: unknown parent: found 'wrld', wanted the name of an earlier body (did you mean 'world'?)"},
    {"body a {}\nbody b {}\n^shape s (a) { size=[1 1 1]@@ }", " type=0",
     "shape 's': attribute 'type' is missing: wanted type=0 .. type=11"},
    {"body a {}\nbody b {}\nshape s (a @b@) { type=0 }", "",
     "shape 's': found 2 parents, wanted one body, or none"},
    {"body a {}\nshape (@-2@) { type=0 }", "-1",
     "parent: found -2, wanted -1 to -1, the statements before this one"},
    {"body a {}\nshape (a) { type=0 }\nshape (@-1@) { type=0 }", "-2",
     "shape: parent: found -1, which is not a body, wanted the number of statements back to a body"},
    // joints
    {"body arm {}\nbody hand {}\njoint (arm @hnad@) {}", "hand",
     "joint 'arm>hnad': unknown child: found 'hnad', wanted the name of an earlier body (did you mean "
     "'hand'?)"},
    {"body a {}\nbody b {}\n^joint j (a@@) {}", " b",
     "joint 'j': found 1 body, wanted two: joint NAME (FROM TO) {...}"},
    {"body a {}\nbody b {}\njoint j (a @a@) {}", "b",
     "joint 'j': found 'a' attached to itself, wanted two different bodies"},
    {"body a {}\nbody b {}\njoint j (a @world@) {}", "b",
     "joint 'j': found the world as the body that moves, wanted a body"},
    {"body a {}\nbody b {}\nbody b {}\njoint j (a @-1@) {}", "-2",
     "joint 'j': found -1, a further body 'b', wanted the first body of its name"},
    {"body a {}\nbody b {}\njoint j (a b) { type=@hingQ@ }", "hingeZ",
     "joint 'j': unknown type: found 'hingQ', wanted a number from 0 to 14 or a name such as 'hingeX' (did "
     "you "
     "mean 'hingeX', 'hingeY' or 'hingeZ'?)"},
    {"body a {}\nbody b {}\njoint j (a b) { type=^screw@@ }", " pitch=.1",
     "joint 'j': attribute 'pitch' is missing: wanted metres per turn of the screw"},
    {"body a {}\nbody b {}\njoint j (a b) { axis=^[0 0 @0@] }", "1",
     "joint 'j': attribute 'axis': found a zero vector, wanted a direction"},
    {"body a {}\nbody b {}\njoint j (a b) { @type=rigid @limits=^[-1 1] }", "",
     "joint 'j': attribute 'limits': found an array of 2, wanted none: a rigid joint does not move"},
    {"body a {}\nbody b {}\njoint j (a b) { limits=@[1]@ }", "[1 2]",
     "joint 'j': attribute 'limits': found an array of 1, wanted an array of 2 numbers"},
    {"body a {}\nbody b {}\njoint j (a b) { limits=@[1 -1]@ }", "[-1 1]",
     "joint 'j': attribute 'limits': found 1 > -1, wanted pairs 'low high' with low <= high"},
    {"body a {}\nbody b {}\njoint j (a b) { ctrl_limits=@[1 -1 0]@ }", "[1 1 0]",
     "joint 'j': attribute 'ctrl_limits': found -1, wanted the largest velocity and effort, both >= 0"},
    {"body a {}\nbody b {}\njoint j (a b) { armature=@-1@ }", "1",
     "joint 'j': attribute 'armature': found -1, wanted a number >= 0"},
    {"body a {}\nbody b {}\njoint j (a b) { stiffness=@-1@ }", "1",
     "joint 'j': attribute 'stiffness': found -1, wanted a number >= 0"},
    {"body a {}\nbody b {}\njoint j (a b) { damping=@-1@ }", "1",
     "joint 'j': attribute 'damping': found -1, wanted a number >= 0"},
    {"body a {}\nbody b {}\njoint j (a b) { type=universal q=@1@ }", "[1 0]",
     "joint 'j': attribute 'q': found the number 1, wanted an array of 2 numbers"},
    {"body a {}\nbody b {}\njoint j (a b) { type=quatBall q=@[0 0 0 0]@ }", "[1 0 0 0]",
     "joint 'j': attribute 'q': found a quaternion of length 0, wanted a quaternion w x y z that can be "
     "normalised"},
    {"body a {}\nbody b {}\njoint j (a b) { type=quatBall stiffness=1 spring_reference=@[0 0 0 0]@ }",
     "[1 0 0 0]",
     "joint 'j': attribute 'spring_reference': found a quaternion of length 0, wanted a quaternion w x y z "
     "that "
     "can be normalised"},
    {"body a {}\nbody b {}\njoint j (a b) { mimic=@3@ }\nbody c {}\njoint three (a c) {}", "three",
     "joint 'j': attribute 'mimic': found the number 3, wanted the name of a joint"},
    // the tree
    {"body a {}\nbody b {}\nbody c {}\nbody d {}\njoint j (a b) {}\n^joint k (c @b@) {}", "d",
     "joint 'k': body 'b' is already attached to a joint: found joint 'j', wanted one joint leading to each "
     "body"},
    {"body a {}\nbody b {}\nbody c {}\njoint j (a b) {}\n^joint @j@ (a c) {}", "k",
     "duplicate joint 'j': wanted a name of its own: the first is at f:4:1"},
    {"body a {}\nbody b {}\nbody c {}\njoint j (a b) {}\n^joint k (b @a@) {}", "c",
     "joint 'k': joints form a loop: found b > a > b, wanted a tree"},
    {"body a {}\nbody b {}\nbody c {}\njoint lead (a b) {}\njoint j (a c) { mimic=@laed@ }", "lead",
     "joint 'j': attribute 'mimic': unknown joint: found 'laed', wanted the name of a joint (did you mean "
     "'lead'?)"},
    {"body a {}\nbody b {}\nbody c {}\nbody d {}\njoint one (a b) {}\njoint two (a c) { mimic=one }\n"
     "joint three (a d) { mimic=@two@ }",
     "one",
     "joint 'three': attribute 'mimic': found 'two', which mimics 'one', wanted a joint that mimics no "
     "other"},
    {"body a {}\nbody b {}\nbody c {}\njoint j (a b) { @fixed@ }\njoint k (a c) { type=1 mimic=^j }", "",
     "joint 'k': attribute 'mimic': found 'j', a joint of type rigid, wanted a joint with one coordinate"},
    {"body a {}\nbody b {}\nbody c {}\njoint j (a b) {}\njoint k (a c) { mimic=^j @type=free@ }", "type=1",
     "joint 'k': attribute 'mimic': found 'j', a joint of type hinge, wanted a joint of type free, like this "
     "one"},
    {"body a {}\nbody b {}\nbody c {}\njoint j (a b) { type=9 }\njoint k (a c) { mimic=j mimic_ratio=@2@ }",
     "1", "joint 'k': attribute 'mimic_ratio': found 2, wanted none, because the joint has 2 coordinates"},
    {"body a {}\nbody b {}\nbody c {}\njoint j (a b) { type=9 }\njoint k (a c) { mimic=j mimic_offset=@2@ }",
     "0", "joint 'k': attribute 'mimic_offset': found 2, wanted none, because the joint has 2 coordinates"},
};

constexpr Row kNotes[] = {
    {"@@# nothing", "body a {}", "warning: no statement: the scene is empty"},
    {"body a {}\n^body @a@ {}", "b", "note: body 'a': a second body of this name: references mean the first"},
    {"body world { fixed @mass=^1@ }", "",
     "warning: body 'world': attribute 'mass' is ignored: the world itself does not move"},
    {"body world { fixed @buoyancy=^1@ }", "",
     "warning: body 'world': attribute 'buoyancy' is ignored: the world itself does not move"},
    {"body world { @kinematic@ }", "fixed",
     "warning: body 'world': attribute 'kinematic' is ignored: the world itself does not move"},
    {"body a { mass=1 @mass=2@ }", "",
     "warning: body 'a': attribute 'mass' is given twice: the first counts"},
    {"body a { type=0 contact=@flase@ }", "false",
     "warning: body 'a': attribute 'contact' counts as true: 'flase' is neither true nor false (did you mean "
     "'false'?)"},
    {"body a { @@color=^[1 0 0] }", "type=0 ",
     "warning: body 'a': attribute 'color' is ignored: without 'type' the body has no shape"},
    {"body @fixd@ post {}", "fixed",
     "warning: body 'post': unknown word 'fixd' is ignored (did you mean 'fixed'?)"},
    {"shape hidden @big many@ s { type=0 }", "contact", "warning: shape 's': unknown word 'big' is ignored"},
    {"body a {}\nbody b {}\njoint fixed @mass@ j (a b) {}", "",
     "warning: joint 'j': unknown word 'mass' is ignored"},
    {"^shape { type=2@@ }", " size=[0 0 1 1]",
     "warning: shape: attribute 'size' is missing: the radius, its fourth number, is 0"},
    {"shape { type=0 @mesh=^'nope.stl'@ }", "",
     "warning: shape: attribute 'mesh' is ignored: a shape of this type has no mesh"},
    {"shape { type=0 @meshscale=^2@ }", "",
     "warning: shape: attribute 'meshscale' is ignored: a shape of this type has no mesh"},
    {"body a {}\nbody b {}\njoint (a b) { @mimic_ratio=^2@ }", "",
     "warning: joint 'a>b': attribute 'mimic_ratio' is ignored: without 'mimic' the joint follows no other"},
    {"body a {}\nbody b {}\njoint (a b) { @mimic_offset=^2@ }", "",
     "warning: joint 'a>b': attribute 'mimic_offset' is ignored: without 'mimic' the joint follows no other"},
    {"body a {}\nbody b {}\njoint (a b) { @spring_reference=^2@ }", "",
     "warning: joint 'a>b': attribute 'spring_reference' is ignored: without 'stiffness' the joint has no "
     "spring"},
    {"body a {}\nbody b {}\njoint (a b) { pitch=^2 @type=0@ }", "type=screw",
     "warning: joint 'a>b': attribute 'pitch' is ignored: only a screw has one"},
    {"body a { type=1 size=^[0 0 0@@] }", " 1",
     "warning: body 'a': attribute 'size' has three numbers: the radius, its fourth, is 0"},
    {"body a { X=<T ^d(90 0 0 @0@)> }", "1",
     "warning: pose element 'd' about a zero axis has no effect: give the axis x y z"},
    {"body a {}\nbody b {}\njoint j (a b) { type=hingeZ Q=^<T d(90 0 @1 0@)> }", "0 1",
     "warning: joint 'j': attribute 'Q' is not a motion of this joint: only the part that the joint can "
     "perform counts"},
    {"body a {}\nbody b {}\njoint j (a b) { limits=[-1 1] q=@2@ }", "1",
     "warning: joint 'j': attribute 'q' starts outside the limits: 2 is not in -1 .. 1"},
    {"body a {}\nbody b {}\njoint j (a b) { limits=@[-90 90]@ }", "[-1 1]",
     "warning: joint 'j': attribute 'limits' is more than two turns: degrees? Angles are radians"},
    {"body a { @mas@=1 }", "mass",
     "warning: body 'a': unknown attribute 'mas' is ignored (did you mean 'mass'?)"},
    {"body a { @wheels@=4 }", "mass", "note: body 'a': unknown attribute 'wheels' is ignored"},
    {"body a { mass=1 inertia=@[1 1 5]@ }", "[1 1 1]",
     "warning: body 'a': attribute 'inertia' is physically impossible: one principal moment exceeds the sum "
     "of "
     "the "
     "others"},
    {"body a { @@size=^[1 1 1] }", "type=0 ",
     "warning: body 'a': attribute 'size' is ignored: without 'type' the body has no shape"},
    {"body a { type=@6@ }", "9",
     "note: body 'a': attribute 'type' 6 is retired: read as ST_ssBox, a rounded box"},
    {"body a {}\n^Delete body @b@\nbody b {}", "a",
     "warning: nothing to delete: no earlier statement has the words 'body b'"},
    {"body a {}\nbody b {}\njoint (a b) { m agent=@1@ }", "0",
     "note: joint 'a>b': attribute 'agent' is ignored: one agent moves all joints"},
    {"body a {}\nbody b {}\njoint (a b) { @gains=^[1 1]@ ctrl_H=1 }", "",
     "note: joint 'a>b': attribute 'gains' is ignored: controllers are written in programs"},
    {"body a {}\nbody b {}\njoint (a b) { A=<T t(0 0 1)> @X=^<T>@ }", "",
     "note: joint 'a>b': attribute 'X' is ignored: the joint has A or B"},
    {"body a {}\nbody b {}\njoint (a b) { @limit@=[-1 1] }", "limits",
     "warning: joint 'a>b': unknown attribute 'limit' is ignored (did you mean 'limits'?)"},
};

TEST(OrsMessages, SayWhatIsWrongWhere) {
  for (const Row& row : kErrors) {
    SCOPED_TRACE(row.text);
    EXPECT_EQ(errorOf(withTypo(row)), expected(row));
    EXPECT_EQ(errorOf(corrected(row)), "");
  }
}

TEST(OrsMessages, TellWhatIsIgnoredOrStrange) {
  for (const Row& row : kNotes) {
    SCOPED_TRACE(row.text);
    const Diagnostics notes = parseOrs(withTypo(row), "f").notes;
    ASSERT_EQ(notes.size(), 1u);
    EXPECT_EQ(toString(notes[0]), expected(row));
    EXPECT_TRUE(parseOrs(corrected(row), "f").notes.empty());
  }
}

}  // namespace rex::ors_messages_test
