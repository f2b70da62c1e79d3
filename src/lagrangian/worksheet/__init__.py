"""Exercises from systems: question sheets, solutions, and random variants of the same difficulty."""

from lagrangian.worksheet.sheet import SheetFormat, Worksheet, sheet_files, worksheet

__all__ = ["SheetFormat", "Worksheet", "sheet_files", "worksheet"]
