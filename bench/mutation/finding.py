# SPDX-License-Identifier: Apache-2.0
"""Finds the places of one source that can be mutated, on the syntax tree of libclang.

Left out: constexpr, static_assert, case labels, enumerators, template arguments, bounds of arrays, whatever comes from a
macro, and operators of classes."""
import dataclasses
import re

from clang.cindex import CursorKind as Kind
from clang.cindex import TypeKind

WHOLE = {TypeKind.CHAR_S, TypeKind.CHAR_U, TypeKind.SCHAR, TypeKind.UCHAR, TypeKind.SHORT, TypeKind.USHORT, TypeKind.INT,
         TypeKind.UINT, TypeKind.LONG, TypeKind.ULONG, TypeKind.LONGLONG, TypeKind.ULONGLONG}
REAL = {TypeKind.FLOAT, TypeKind.DOUBLE, TypeKind.LONGDOUBLE}
NUMBER = WHOLE | REAL | {TypeKind.BOOL}
ARITHMETIC = {"+": "add", "-": "subtract", "*": "multiply", "/": "divide", "%": "remainder"}
COMPARISONS = {"<": "less", ">": "greater", "<=": "at_most", ">=": "at_least"}
EQUALITIES = {"==": "equal", "!=": "differs"}
COMPOUND = {"+=": "add_to", "-=": "subtract_from", "*=": "multiply_by", "/=": "divide_by"}
FIXED = re.compile(rb"\b(constexpr|consteval|constinit)\b")
LEFT_OUT = {Kind.STATIC_ASSERT, Kind.ENUM_DECL, Kind.TYPE_ALIAS_DECL, Kind.TYPEDEF_DECL, Kind.MACRO_INSTANTIATION,
            Kind.MACRO_DEFINITION, Kind.INCLUSION_DIRECTIVE, Kind.USING_DECLARATION}
STATEMENTS = {Kind.CALL_EXPR, Kind.BINARY_OPERATOR, Kind.COMPOUND_ASSIGNMENT_OPERATOR, Kind.CXX_THROW_EXPR,
              Kind.UNEXPOSED_EXPR, Kind.UNARY_OPERATOR}


@dataclasses.dataclass
class Place:
    """A place: what it becomes (a function of runtime.hpp, or a way of writing), its extent, and where its operator is."""

    kind: str
    begin: int
    end: int
    operator: tuple = ()  # of an operator with two sides, the offsets of the operator
    type: str = ""        # of a constant
    mutants: tuple = ()   # what each mutant is, in words


class Finder:
    def __init__(self, unit, path):
        self.path, self.places, self.text = path, [], path.read_bytes()
        self.macros = []
        for cursor in unit.cursor.get_children():
            if self.here(cursor) and cursor.kind == Kind.MACRO_INSTANTIATION:
                self.macros.append(self.extent(cursor))
        for cursor in unit.cursor.get_children():
            if self.here(cursor):
                self.visit(cursor, None, [])

    def here(self, cursor):
        return cursor.location.file is not None and cursor.location.file.name == str(self.path)

    @staticmethod
    def extent(cursor):
        return cursor.extent.start.offset, cursor.extent.end.offset

    def add(self, kind, begin, end, mutants, **more):
        if begin < end and not any(begin < stop and start < end for start, stop in self.macros):
            self.places.append(Place(kind, begin, end, mutants=mutants, **more))

    def visit(self, cursor, parent, above):
        """`above`: the cursors over this one, nearest last."""
        if cursor.kind in LEFT_OUT:
            return
        begin, end = self.extent(cursor)
        if cursor.kind.is_declaration() and cursor.kind not in (Kind.NAMESPACE, Kind.CLASS_DECL, Kind.STRUCT_DECL):
            # Of several variables in one declaration only the first has the specifiers in its extent.
            start = max(self.text.rfind(mark, 0, begin) for mark in (b";", b"{", b"}", b")")) + 1
            if FIXED.search(self.text[start:max(begin, cursor.location.offset)]):
                return
        children = list(cursor.get_children())
        fixed_condition = cursor.kind == Kind.IF_STMT and re.match(rb"if\s+constexpr", self.text[begin:end])
        if fixed_condition or cursor.kind == Kind.CASE_STMT:
            children = children[1:]
        elif not self.skip(cursor):
            self.look(cursor, children, begin, end, above)
        if parent is not None and cursor.kind in STATEMENTS | {Kind.CONTINUE_STMT, Kind.BREAK_STMT}:
            self.statement(parent, begin, end)
        for child in children:
            inside = cursor if cursor.kind == Kind.COMPOUND_STMT or self.is_body(cursor, child) else None
            self.visit(child, inside, above + [cursor])

    def skip(self, cursor):
        return not cursor.kind.is_expression() and cursor.kind not in (Kind.IF_STMT, Kind.WHILE_STMT)

    def is_body(self, cursor, child):
        """Whether the child is a statement that hangs on an `if` or a loop without braces."""
        if cursor.kind not in (Kind.IF_STMT, Kind.FOR_STMT, Kind.WHILE_STMT, Kind.CXX_FOR_RANGE_STMT):
            return False
        begin, end = self.extent(child)
        if cursor.kind == Kind.FOR_STMT and end + 1 < self.extent(cursor)[1]:
            return False  # its parts end with a semicolon too
        before = self.text[:begin].rstrip()
        return before.endswith((b")", b"else"))

    def statement(self, parent, begin, end):
        """A statement that may be left out, with its semicolon."""
        rest = re.match(rb"\s*;", self.text[end:])
        if rest:
            self.add("statement", begin, end + rest.end(), ("statement left out",))

    def look(self, cursor, children, begin, end, above):
        if cursor.kind == Kind.BINARY_OPERATOR and len(children) == 2:
            self.binary(children, begin, end)
        elif cursor.kind == Kind.COMPOUND_ASSIGNMENT_OPERATOR and len(children) == 2:
            name = self.operator(children)
            if name in COMPOUND and self.numbers(children):
                self.two_sided(COMPOUND[name], children, begin, end, (f"{name} turned round",))
        elif cursor.kind == Kind.UNARY_OPERATOR and children and self.extent(children[0])[0] > begin:
            name = self.text[begin:self.extent(children[0])[0]].strip()
            if name == b"-" and self.numbers(children) and children[0].kind not in (Kind.INTEGER_LITERAL, Kind.FLOATING_LITERAL):
                self.add("negative", begin, end, ("minus left out",), operator=(begin, self.extent(children[0])[0]))
            elif name == b"!":
                self.add("negation", begin, end, ("! left out",), operator=(begin, self.extent(children[0])[0]))
        elif cursor.kind in (Kind.INTEGER_LITERAL, Kind.FLOATING_LITERAL):
            self.constant(cursor, begin, end, above)
        elif cursor.kind in (Kind.IF_STMT, Kind.WHILE_STMT, Kind.CONDITIONAL_OPERATOR):
            self.condition(cursor, children)

    def operator(self, children):
        between = self.text[self.extent(children[0])[1]:self.extent(children[1])[0]]
        return between.strip().decode(errors="replace")

    def numbers(self, children):
        return all(child.type.get_canonical().kind in NUMBER for child in children)

    def two_sided(self, kind, children, begin, end, mutants):
        operator = (self.extent(children[0])[1], self.extent(children[1])[0])
        self.add(kind, begin, end, mutants, operator=operator)

    def binary(self, children, begin, end):
        name = self.operator(children)
        if name in ("&&", "||"):
            for child in children:
                self.add("and" if name == "&&" else "or", *self.extent(child), (f"operand of {name} left out",))
            return
        if not self.numbers(children):
            return
        kinds = {child.type.get_canonical().kind for child in children}
        if name in ARITHMETIC:
            self.two_sided(ARITHMETIC[name], children, begin, end, (f"{name} turned round",))
        elif name in EQUALITIES:
            self.two_sided(EQUALITIES[name], children, begin, end, (f"{name} turned round",))
        elif name in COMPARISONS and kinds & REAL:
            self.two_sided(COMPARISONS[name], children, begin, end, (f"{name} turned round",))
        elif name in COMPARISONS:
            mutants = (f"{name} turned round", f"{name} off by one")
            self.two_sided(COMPARISONS[name] + "_whole", children, begin, end, mutants)

    def condition(self, cursor, children):
        """The condition of an `if`, of `while` or of `?:`, where it is no operator that has mutants of its own."""
        for child in children:
            begin, end = self.extent(child)
            if not child.kind.is_expression():
                continue
            if cursor.kind != Kind.CONDITIONAL_OPERATOR and self.text[end:].lstrip()[:1] != b")":
                continue
            if child.kind not in (Kind.BINARY_OPERATOR, Kind.UNARY_OPERATOR, Kind.PAREN_EXPR):
                self.add("condition", begin, end, ("condition turned round",))
            return

    def constant(self, cursor, begin, end, above):
        """The type is the one to which the constant is converted in its place: 1 in std::size_t{1} is no int."""
        type = cursor.type
        for over in reversed(above):
            if over.kind != Kind.UNEXPOSED_EXPR or self.extent(over) != (begin, end):
                break
            type = over.type
        type = type.get_canonical()
        if type.kind not in NUMBER - {TypeKind.BOOL} or self.text[end:end + 1] == b">":
            return
        if self.text[begin - 1:begin] == b"[" and above and above[-1].kind.is_declaration():
            return
        spelling = type.spelling.removeprefix("const ")
        if type.kind in REAL:
            self.add("real", begin, end, ("constant changed",), type=spelling)
        elif self.text[begin:end].strip(b"uUlL") in (b"0", b"0x0"):
            self.add("whole", begin, end, ("constant one more",), type=spelling)
        else:
            self.add("whole_from_one", begin, end, ("constant one more", "constant one less"), type=spelling)
