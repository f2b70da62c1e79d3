"""The content of a page as data, without mechanics or markup: words, formulas, tables, checks, reports."""
