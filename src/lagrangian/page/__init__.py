"""What a page says, as data that knows neither mechanics nor markup: words, formulas, tables, checks, reports."""
